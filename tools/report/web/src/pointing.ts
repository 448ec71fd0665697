// Pointing at things of the 3D view: what they are, and how far they are from each other.
import type * as three from "three";
import { make, number } from "./dom";
import type { Picked } from "./pick";

/** Tells what was picked, and the distance to what was picked before where that is asked for. */
export class Pointing {
  readonly element = make("p", { class: "picked", role: "status" });
  readonly button: HTMLButtonElement;
  private isMeasuring = false;
  private begin: three.Vector3 | null = null;

  constructor(private readonly goTo: (view: number) => void) {
    this.button = make("button", { type: "button", class: "small", "aria-pressed": "false",
      title: "Then pick two things: their distance is told" }, "Measure");
    this.button.addEventListener("click", () => {
      this.isMeasuring = !this.isMeasuring;
      this.begin = null;
      this.button.setAttribute("aria-pressed", String(this.isMeasuring));
      this.say(this.isMeasuring ? "Pick the first of two things." : "");
    });
  }

  tell(picked: Picked | null) {
    if (!picked) {
      if (!this.isMeasuring) this.say("");
      return;
    }
    const place = picked.at.toArray().map((x) => number(x, 2)).join(", ");
    if (this.isMeasuring && this.begin) {
      this.say(`${number(this.begin.distanceTo(picked.at), 3)} m between the two things.`);
      this.begin = null;
      return;
    }
    if (this.isMeasuring) this.begin = picked.at;
    const { view } = picked;
    this.say(`${picked.what}, at ${place} m. `, view === null || this.isMeasuring ? null
      : make("button", { type: "button", class: "small", click: () => this.goTo(view) },
        `Go to view ${view + 1}`));
    if (this.isMeasuring) this.element.append("Pick the second.");
  }

  private say(...what: (Node | string | null)[]) {
    this.element.replaceChildren(...what.filter((part) => part !== null));
  }
}
