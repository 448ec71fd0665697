// A line across the 3D view that can be drawn: left of it the true structure, right of it the
// surface that the run's pictures gave.
import { make } from "./dom";

export class Swipe {
  readonly element = make("label", { class: "swipe" });
  share = 0.5; // of the view's width
  private readonly input = make("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5,
    "aria-label": "True structure to the left, reconstructed surface to the right" });
  private readonly line = make("i", {});

  constructor(changed: () => void) {
    this.element.append(make("span", {}, "truth"), this.input, make("span", {}, "surface"),
      this.line);
    this.element.hidden = true;
    this.input.addEventListener("input", () => {
      this.share = Number(this.input.value);
      this.place();
      changed();
    });
    this.place();
  }

  show(isShown: boolean) { this.element.hidden = !isShown; }

  private place() { this.line.style.left = `${100 * this.share}%`; }
}
