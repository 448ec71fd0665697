// What the cameras saw, colour and depth, beside the 3D view.
import type { Clock } from "./clock";
import { rampGradient } from "./colours";
import type { FrameData } from "./data";
import { colourBar, make, measure, number } from "./dom";
import { rangeOf, type Flight } from "./flight";

const kDialog = make("dialog", { class: "large", "aria-label": "Picture" });
kDialog.addEventListener("click", () => kDialog.close());

/** The frames that the cameras took at the present view, or at the nearest one that was kept. */
export class FrameStrip {
  readonly element = make("div", { class: "frames strip" });
  private key = "";

  show(flights: Flight[], clock: Clock) {
    const kept = flights.filter((flight) => flight.data.frames.length > 0);
    const nearest = kept.map((flight) => nearestView(flight, flight.viewsAt(clock) - 1));
    // before the first view there is none to show: the one that comes is
    const before = kept.map((flight) => (flight.viewsAt(clock) === 0 ? "next: " : ""));
    const key = kept.map((flight, i) => `${flight.index}:${before[i]}${nearest[i]}`).join();
    if (key === this.key) return;
    this.key = key;
    if (kDialog.open) kDialog.close();
    this.element.replaceChildren(...kept.flatMap((flight, i) => figuresOf(flight, nearest[i],
      (flights.length > 1 ? `${flight.data.label}: ` : "") + before[i])));
  }
}

const cameraName = (name: string) => name.replaceAll("_", " ").replace(/^rgbd\b/, "RGBD camera")
  .replace(/^zed mini\b/, "ZED Mini");

/** What the cameras saw at a view; nothing where it was not kept. */
export function figuresOf({ data }: Flight, view: number, before = ""): HTMLElement[] {
  return data.frames.filter((frame) => frame.view === view).flatMap((frame) => {
    const name = `${before}view ${view + 1}, ${cameraName(frame.camera)}`;
    return [figure(frame, frame.jpeg, name, []),
      figure(frame, frame.depth_jpeg, `${name}, depth`, depthKey(rangeOf(data.cameras)))];
  });
}

function figure({ width_px: width, height_px: height }: FrameData, jpeg: FrameData["jpeg"],
    name: string, key: HTMLElement[]): HTMLElement {
  const url = URL.createObjectURL(new Blob([jpeg], { type: "image/jpeg" }));
  const image = make("img", { src: url, width, height, alt: name });
  image.addEventListener("load", () => URL.revokeObjectURL(url));
  const open = make("button", { type: "button", class: "picture", title: "As large as it goes",
    "aria-label": `Enlarge ${name}`, click: () => enlarge(image, name) }, image);
  return make("figure", { class: "card frame" }, open, make("figcaption", {}, name, ...key));
}

function enlarge(image: HTMLImageElement, name: string) {
  const canvas = make("canvas", { width: image.naturalWidth, height: image.naturalHeight,
    role: "img", "aria-label": name });
  canvas.getContext("2d")?.drawImage(image, 0, 0);
  kDialog.replaceChildren(canvas, make("p", { class: "fine" }, name),
    make("button", { type: "button", click: () => kDialog.close() }, "Close"));
  (document.fullscreenElement ?? document.body).append(kDialog);
  kDialog.showModal();
}

function depthKey(range_m: number): HTMLElement[] {
  const key = colourBar(rampGradient("amount"), "", ["0", number(range_m / 2, 1),
    measure(number(range_m), "m")], "");
  key.className = "depth-key";
  return [key];
}

function nearestView({ data: { frames } }: Flight, view: number): number {
  return frames.reduce((best, frame) =>
    (Math.abs(frame.view - view) < Math.abs(best - view) ? frame.view : best), frames[0].view);
}
