// What lies over the 3D view: its axes, and the line between truth and surface.
import { Vector3, type Camera } from "three";
import { make } from "./dom";

const kAxes: [string, string, Vector3][] = [["x east", "#c0392b", new Vector3(1, 0, 0)],
  ["y north", "#2e8b57", new Vector3(0, 1, 0)], ["z up", "#2360d8", new Vector3(0, 0, 1)]];

/** East, north and up as they lie in the picture. */
export class Axes {
  readonly element = make("div",
    { class: "axes", role: "img", "aria-label": "Axes: x east, y north, z up" });

  show(camera: Camera) {
    const back = camera.quaternion.clone().invert();
    const drawn = kAxes.map(([name, colour, axis]) => {
      const way = axis.clone().applyQuaternion(back).multiplyScalar(24);
      const anchor = way.x < -5 ? "end" : way.x > 5 ? "start" : "middle";
      return `<path stroke="${colour}" stroke-width="2" d="M0 0L${way.x} ${-way.y}"/>`
        + `<text x="${way.x + 3 * Math.sign(Math.round(way.x / 12))}" `
        + `y="${-way.y + (way.y < 0 ? 10 : -3)}" fill="${colour}" text-anchor="${anchor}">${
          name}</text>`;
    });
    this.element.innerHTML = `<svg viewBox="-75 -42 150 84">${drawn.join("")}</svg>`;
  }
}

/**
 * A line across the 3D view that can be drawn: left of it the true structure, right of it the
 * surface that the run's pictures gave.
 */
export class Swipe {
  share = 0.5; // of the view's width
  private readonly input = make("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5,
    "aria-label": "True structure to the left, reconstructed surface to the right",
    input: () => {
      this.share = Number(this.input.value);
      this.element.style.setProperty("--share", `${100 * this.share}%`);
      this.changed();
    } });
  readonly element = make("label", { class: "swipe", hidden: true }, make("span", {}, "truth"),
    this.input, make("span", {}, "surface"), make("i", {}));

  constructor(private readonly changed: () => void) {}
}
