// Pointing at things of the 3D view: what they are, what was seen from there, which views had them
// in their pictures, and how far they are from each other.
import * as three from "three";
import { make, number } from "./dom";
import { figuresOf } from "./panels";
import type { RunScene } from "./run_scene";

/** What a pointer can name. */
export interface Thing {
  at: three.Vector3;
  ahead: number; // of what lies in front of it by that depth
  view: number | null; // index of a view to go to
  isView?: boolean; // it is that view itself
  what(): string;
}

/** What lies in front within `near_px` of `x`, `y` of a pane of that size. */
export function pick(scene: RunScene, camera: three.Camera, x: number, y: number, width: number,
    height: number, near_px: number): Thing | null {
  let best: Thing | null = null;
  let depth = Infinity;
  const seen = new three.Vector3();
  for (const thing of scene.things()) {
    seen.copy(thing.at).project(camera);
    const away_px = Math.hypot((seen.x + 1) / 2 * width - x, (1 - seen.y) / 2 * height - y);
    if (Math.abs(seen.z) > 1 || away_px > near_px || seen.z - thing.ahead >= depth) continue;
    depth = seen.z - thing.ahead;
    best = { ...thing, at: thing.at.clone() };
  }
  return best;
}

const kNear_m = 0.1; // what lies so near the place hides nothing: it is the same surface
const kNear_voxels = 2;

/**
 * Indices of the views that had a place in their pictures. No run records that: a view counts that
 * had it within a camera's pyramid and range, with no face of the structure in between or, where
 * that cannot be had, no voxel that holds points. The page's structure may have fewer faces than the
 * true one, and points are measured: it is about right, and is called so.
 */
export function viewsThatSaw(place: three.Vector3, scene: RunScene): number[] {
  return [...Array(scene.flight.count).keys()].filter((view) =>
    scene.flight.camerasInWorld(view).some(({ camera, T }) => {
      const { x, y, z } = place.clone().applyMatrix4(T.clone().invert());
      return z > 0 && Math.hypot(x, y, z) <= camera.range_m
        && Math.abs(x) <= z * Math.tan(camera.fov_x / 2)
        && Math.abs(y) <= z * Math.tan(camera.fov_y / 2)
        && !isHidden(place, new three.Vector3().setFromMatrixPosition(T), scene);
    }));
}

function isHidden(place: three.Vector3, from: three.Vector3,
    { structure, model: { densities } }: RunScene): boolean {
  const way = place.clone().sub(from).normalize();
  const away = place.distanceTo(from);
  if (structure) return structure.hides(from, way, away - kNear_m);
  const far = away - kNear_voxels * densities.voxels.size_m;
  return densities.firstHit(from, way, far, Infinity) < far;
}

const kMostNamed = 8;

/** Tells what was picked, and the distance to what was picked before where that is asked for. */
export class Pointing {
  readonly element = make("div", { class: "picked", role: "status" });
  readonly button = make("button", { class: "small", "aria-pressed": "false",
    title: "Then pick two things: their distance is told",
    click: () => this.measure() }, "Measure");
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
