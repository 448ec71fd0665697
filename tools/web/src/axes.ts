// East, north and up as they lie in the picture.
import * as three from "three";
import { make } from "./dom";

const kAxes: [string, string, three.Vector3][] = [["x east", "#c0392b", new three.Vector3(1, 0, 0)],
  ["y north", "#2e8b57", new three.Vector3(0, 1, 0)],
  ["z up", "#2360d8", new three.Vector3(0, 0, 1)]];
const kWidth = 150;
const kHeight = 84;

export class Axes {
  readonly element = make("canvas", { class: "axes", width: 2 * kWidth, height: 2 * kHeight,
    role: "img", "aria-label": "Axes: x east, y north, z up" });
  private shown = "";

  show(camera: three.Camera) {
    const key = camera.quaternion.toArray().map((c) => c.toFixed(2)).join();
    if (key === this.shown) return;
    this.shown = key;
    const context = this.element.getContext("2d");
    if (!context) return;
    context.setTransform(2, 0, 0, 2, 0, 0);
    context.clearRect(0, 0, kWidth, kHeight);
    context.font = "600 10px system-ui, sans-serif";
    context.lineWidth = 2;
    const back = camera.quaternion.clone().invert();
    for (const [name, colour, axis] of kAxes) {
      const way = axis.clone().applyQuaternion(back);
      const [x, y] = [kWidth / 2 + 24 * way.x, kHeight / 2 - 24 * way.y];
      context.strokeStyle = context.fillStyle = colour;
      context.beginPath();
      context.moveTo(kWidth / 2, kHeight / 2);
      context.lineTo(x, y);
      context.stroke();
      context.textAlign = way.x < -0.2 ? "right" : way.x > 0.2 ? "left" : "center";
      context.fillText(name, x + 3 * Math.sign(Math.round(2 * way.x)), y + (way.y < 0 ? 10 : -3));
    }
  }
}
