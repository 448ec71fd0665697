// What the cameras saw, colour and depth, beside the 3D view.
import { rampGradient } from "./colours";
import type { FrameData } from "./data";
import { colourBar, make, measure, number, type Child } from "./dom";
import type { Flight } from "./flight";
import { ofLabel } from "./panels";

/** The frames that the cameras took at the present view, or at the nearest one that was kept. */
export class FrameStrip {
  readonly element = make("div", { class: "frames strip" });
  private key = "";

  show(flights: Flight[]) {
    const kept = flights.filter(({ data }) => data.frames.length > 0).map((flight) => ({ flight,
      view: nearestView(flight, flight.n - 1),
      // before the first view there is none to show: the one that comes is
      before: flight.n === 0 ? "next: " : "" }));
    const key = kept.map(({ flight, view, before }) => `${flight.index}:${before}${view}`).join();
    if (key === this.key) return;
    this.key = key;
    this.element.replaceChildren(...kept.flatMap(({ flight, view, before }) =>
      figuresOf(flight, view, ofLabel(flights, flight.data) + before)));
  }
}

const cameraName = (name: string) => name.replaceAll("_", " ").replace(/^rgbd\b/, "RGBD camera")
  .replace(/^zed mini\b/, "ZED Mini");

/** What the cameras saw at a view; nothing where it was not kept. */
export function figuresOf({ data, range_m }: Flight, view: number, before = ""): HTMLElement[] {
  const key = colourBar(rampGradient("amount"), "", ["0", number(range_m / 2, 1),
    measure(number(range_m), "m")], "");
  return data.frames.filter((frame) => frame.view === view).flatMap((frame) => {
    const name = `${before}view ${view + 1}, ${cameraName(frame.camera)}`;
    return [figure(frame, frame.jpeg, name, null),
      figure(frame, frame.depth_jpeg, `${name}, depth`, key.cloneNode(true))];
  });
}

function figure({ width_px: width, height_px: height }: FrameData, jpeg: FrameData["jpeg"],
    name: string, key: Child): HTMLElement {
  const url = URL.createObjectURL(new Blob([jpeg], { type: "image/jpeg" }));
  const image = make("img",
    { src: url, width, height, alt: name, load: () => URL.revokeObjectURL(url) });
  const open = make("button", { class: "picture", title: "As large as it goes; Escape leaves it",
    "aria-label": `Enlarge ${name}`, click: () => void image.requestFullscreen() }, image);
  return make("figure", { class: "card frame" }, open, make("figcaption", {}, name, key));
}

function nearestView({ data: { frames } }: Flight, view: number): number {
  return frames.reduce((best, frame) =>
    (Math.abs(frame.view - view) < Math.abs(best - view) ? frame.view : best), frames[0].view);
}
