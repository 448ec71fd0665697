// Pointing at things of the 3D view: what they are, what was seen from there, which views had them
// in their pictures, and how far they are from each other.
import type * as three from "three";
import { make, number } from "./dom";
import { figuresOf } from "./frame_strip";
import { viewsThatSaw, type Picked } from "./pick";
import type { RunScene } from "./run_scene";

const kMostNamed = 8;

/** Tells what was picked, and the distance to what was picked before where that is asked for. */
export class Pointing {
  readonly element = make("div", { class: "picked", role: "status" });
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

  tell(picked: Picked | null, scene: RunScene) {
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
    const what = `${picked.what}, at ${place} m. `;
    if (this.isMeasuring) {
      this.begin = picked.at;
      this.say(`${what}Pick the second.`);
    } else if (picked.isView) {
      this.say(make("p", {}, what, this.goButton(picked.view!, `Go to view ${picked.view! + 1}`)),
        make("div", { class: "frames" }, ...figuresOf(scene.flight, picked.view!)));
    } else {
      this.say(make("p", {}, what, picked.view === null ? null
        : this.goButton(picked.view, `Go to view ${picked.view + 1}`)),
        this.seenBy(picked.at, scene));
    }
  }

  private seenBy(place: three.Vector3, scene: RunScene): HTMLElement {
    const views = viewsThatSaw(place, scene);
    const named = views.filter((_, i) => // spread over all
      views.length <= kMostNamed || i % Math.ceil(views.length / kMostNamed) === 0);
    return make("p", {}, views.length === 0 ? "In sight of no view, as far as voxels tell."
      : `In sight of about ${views.length} ${views.length === 1 ? "view" : "views"}: `,
      ...named.map((view) => this.goButton(view, `${view + 1}`)),
      named.length < views.length ? " …" : "");
  }

  private goButton(view: number, text: string) {
    return make("button", { type: "button", class: "small", "aria-label": `Go to view ${view + 1}`,
      click: () => this.goTo(view) }, text);
  }

  private say(...what: (Node | string)[]) { this.element.replaceChildren(...what); }
}
