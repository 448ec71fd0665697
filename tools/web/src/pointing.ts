// Pointing at things of the 3D view: what they are, what was seen from there, which views had them
// in their pictures, and how far they are from each other.
import type * as three from "three";
import { make, number } from "./dom";
import { figuresOf } from "./frame_strip";
import { viewsThatSaw, type Thing } from "./pick";
import type { RunScene } from "./run_scene";

const kMostNamed = 8;

/** Tells what was picked, and the distance to what was picked before where that is asked for. */
export class Pointing {
  readonly element = make("div", { class: "picked", role: "status" });
  readonly button = make("button", { class: "small", "aria-pressed": "false",
    title: "Then pick two things: their distance is told", click: () => this.measure() }, "Measure");
  private isMeasuring = false;
  private begin: three.Vector3 | null = null;

  constructor(private readonly goTo: (view: number) => void) {}

  private measure() {
    this.isMeasuring = !this.isMeasuring;
    this.begin = null;
    this.button.ariaPressed = String(this.isMeasuring);
    this.say(this.isMeasuring ? "Pick the first of two things." : "");
  }

  tell(thing: Thing | null, scene: RunScene) {
    if (!thing) {
      if (!this.isMeasuring) this.say("");
      return;
    }
    const { at, view } = thing;
    if (this.isMeasuring && this.begin) {
      this.say(`${number(this.begin.distanceTo(at), 3)} m between the two things.`);
      this.begin = null;
      return;
    }
    const what = `${thing.what()}, at ${at.toArray().map((x) => number(x, 2)).join(", ")} m. `;
    if (this.isMeasuring) {
      this.begin = at;
      this.say(`${what}Pick the second.`);
      return;
    }
    this.say(make("p", {}, what, view === null ? null
      : this.goButton(view, `Go to view ${view + 1}`)),
    thing.isView ? make("div", { class: "frames" }, ...figuresOf(scene.flight, view!))
      : this.seenBy(at, scene));
  }

  private seenBy(place: three.Vector3, scene: RunScene): HTMLElement {
    const views = viewsThatSaw(place, scene);
    const every = Math.ceil(views.length / kMostNamed);
    const named = views.filter((_, i) => i % every === 0); // spread over all
    return make("p", {}, views.length === 0 ? "In sight of no view, as far as voxels tell."
      : `In sight of about ${views.length} ${views.length === 1 ? "view" : "views"}: `,
      ...named.map((view) => this.goButton(view, `${view + 1}`)),
      named.length < views.length ? " …" : "");
  }

  private goButton(view: number, text: string) {
    return make("button", { class: "small", "aria-label": `Go to view ${view + 1}`,
      click: () => this.goTo(view) }, text);
  }

  private say(...what: (Node | string)[]) { this.element.replaceChildren(...what); }
}
