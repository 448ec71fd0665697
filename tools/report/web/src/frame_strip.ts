// What the cameras saw, colour and depth, beside the 3D view.
import type { Clock } from "./clock";
import { rampGradient } from "./colours";
import type { Slice } from "./data";
import { make, number } from "./dom";
import type { Flight } from "./flight";

/** The frames that the cameras took at the present view, or at the nearest one that was kept. */
export class FrameStrip {
  readonly element = make("div", { class: "frames" });
  private readonly dialog = make("dialog", { class: "large", "aria-label": "Picture" });
  private key = "";

  constructor() {
    this.dialog.addEventListener("click", () => this.dialog.close());
  }

  show(flights: Flight[], clock: Clock) {
    const kept = flights.filter((flight) => flight.data.frames.length > 0);
    const nearest = kept.map((flight) => nearestView(flight, flight.viewsAt(clock) - 1));
    const key = kept.map((flight, i) => `${flight.index}:${nearest[i]}`).join();
    if (key === this.key) return;
    this.key = key;
    if (this.dialog.open) this.dialog.close();
    this.element.replaceChildren(this.dialog, ...kept.flatMap((flight, i) => flight.data.frames
      .filter(([view]) => view === nearest[i])
      .flatMap(([view, camera, width, height, at, bytes, depthAt, depthBytes]) => {
        const name = `${flights.length > 1 ? `${flight.data.label}: ` : ""}view ${view + 1}, `
          + camera;
        const range = Math.max(...flight.data.cameras.map((each) => each.range_m));
        return [this.figure(flight, [at, bytes], width, height, name, []),
          this.figure(flight, [depthAt, depthBytes], width, height, `${name}, depth`,
            depthKey(range))];
      })));
  }

  private figure(flight: Flight, slice: Slice, width: number, height: number, name: string,
      key: HTMLElement[]): HTMLElement {
    const url = URL.createObjectURL(new Blob([flight.bytes.u8(slice)], { type: "image/jpeg" }));
    const image = make("img", { src: url, width, height, alt: name });
    image.addEventListener("load", () => URL.revokeObjectURL(url));
    const open = make("button", { type: "button", class: "picture", title: "As large as it goes",
      "aria-label": `Enlarge ${name}`, click: () => this.enlarge(image, name) }, image);
    return make("figure", { class: "card frame" }, open, make("figcaption", {}, name, ...key));
  }

  private enlarge(image: HTMLImageElement, name: string) {
    const canvas = make("canvas", { width: image.naturalWidth, height: image.naturalHeight,
      role: "img", "aria-label": name });
    canvas.getContext("2d")?.drawImage(image, 0, 0);
    this.dialog.replaceChildren(canvas, make("p", { class: "fine" }, name),
      make("button", { type: "button", click: () => this.dialog.close() }, "Close"));
    this.dialog.showModal();
  }
}

function depthKey(range_m: number): HTMLElement[] {
  const bar = make("i", { class: "mark bar" });
  bar.style.background = rampGradient("amount");
  return [make("span", { class: "depth-key" }, "0", bar, `${number(range_m, 1)} m; grey: none`)];
}

function nearestView(flight: Flight, view: number): number {
  let best = flight.data.frames[0][0];
  for (const [candidate] of flight.data.frames) {
    if (Math.abs(candidate - view) < Math.abs(best - view)) best = candidate;
  }
  return best;
}
