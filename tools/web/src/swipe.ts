// A line across the 3D view that can be drawn: left of it the true structure, right of it the
// surface that the run's pictures gave.
import { make } from "./dom";

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
