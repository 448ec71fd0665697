// East, north and up as they lie in the picture.
import { Vector3, type Camera } from "three";
import { make } from "./dom";

const kAxes: [string, string, Vector3][] = [["x east", "#c0392b", new Vector3(1, 0, 0)],
  ["y north", "#2e8b57", new Vector3(0, 1, 0)], ["z up", "#2360d8", new Vector3(0, 0, 1)]];

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
