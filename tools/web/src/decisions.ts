// Why this view: the candidates of the decision that chose it, with what became of each; and for
// whose sake: the voxels that its rays were to cross, as they were believed before, and the
// frontiers that views were sampled around.
import * as three from "three";
import { colourOf, cssOf, cssOnPage, isDark, onPage, ramp, rampGradient, reason } from "./colours";
import type { BeliefData, CandidateData } from "./data";
import { make, number, significant } from "./dom";
import type { Flight } from "./flight";
import { ViewMark, makeDots, makeLines, makeTube, numbersOf } from "./marks";
import { tableOf, validWords } from "./panels";
import type { Layers } from "./run_scene";
import type { Model } from "./surfaces";

const kKept = 253; // of a candidate's kind, see page_data.hpp
const kValid = 254;
const kChosen = 255;
const kTermCount = 5; // utility, information, density, prediction, distance
const kBest = 5;
const kRays = [9, 7];

interface Candidate {
  at: three.Vector3;
  way: three.Vector3; // in which it looks
  kind: number; // a reason of rejection, kKept, kValid or kChosen
  terms: Float32Array | null; // of those that competed
}

export class CandidateMarks extends ViewMark {
  private view = -1; // whose decision it is
  now: Candidate[] = []; // those that are drawn
  rayEnds: three.Vector3[] = []; // two a ray
  private burst: Candidate[] = []; // its views, where it is one, in the order of their flight
  private chosen: Candidate | undefined; // as this view

  constructor(private readonly flight: Flight, private readonly model: Model,
      private readonly data: CandidateData) { super(); }

  /** The decision that chose the last of the first `n` views, perhaps with views before it. */
  protected parts(n: number): three.Object3D[] {
    this.view = n - 1;
    this.now = n > 0 ? this.decision(this.flight.planOf(n) - 1) : [];
    this.rayEnds = [];
    this.burst = this.now.filter(({ kind }) => kind === kKept);
    this.chosen = this.burst[this.flight.data.views.plan_view[n - 1] - 1]
      ?? this.now.find(({ kind }) => kind === kChosen);
    return this.now.length === 0 ? [] : [...this.pins(), ...this.chosen ? [this.rays(n - 1)] : []];
  }

  private decision(view: number): Candidate[] {
    const { begins, kind: kinds, points, angles, terms } = this.data;
    let term = kTermCount * begins[2 * view + 1];
    return Array.from(kinds.subarray(begins[2 * view], begins[2 * view + 2]), (kind, k) => {
      const i = begins[2 * view] + k;
      const [yaw, pitch] = angles.subarray(2 * i, 2 * i + 2);
      const competed = kind >= kKept ? terms.subarray(term, term += kTermCount) : null;
      return { at: new three.Vector3().fromArray(points, 3 * i), kind, terms: competed,
        way: new three.Vector3(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch),
          -Math.sin(pitch)) };
    });
  }

  private colourOf({ kind, terms }: Candidate): three.Color {
    if (kind === kChosen || kind === kKept) return new three.Color(colourOf("chosen"));
    if (!terms) return onPage(reason(kind).light);
    const values = this.now.flatMap((other) => other.terms?.[0] ?? []);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    return ramp("score", (terms[0] - low) / (high - low || 1));
  }

  /**
   * A dot where each stands, and a line the way it looks; the chosen one on a rim, over all. A line
   * leads to the views of a burst from the view before.
   */
  private pins(): three.Object3D[] {
    const { flight, now, burst, chosen } = this;
    const rim = new three.Color(isDark() ? 0x000000 : 0xffffff);
    const pinsOf = (all: Candidate[], length: number, dot_px: number, line_px: number,
        colour = (candidate: Candidate) => this.colourOf(candidate)) => {
      const ends = all.flatMap(({ at, way }) =>
        [at, at.clone().addScaledVector(way, length * flight.size_m)]);
      const colours = all.map((candidate) => colour(candidate).toArray());
      return [makeDots(numbersOf(all.map(({ at }) => at)), colours.flat(), dot_px),
        makeTube(numbersOf(ends), colours.flatMap((rgb) => [...rgb, ...rgb]), line_px)];
    };
    const before = flight.viewPose(Math.max(0, flight.planOf(this.view + 1) - 2)).p;
    const legs = burst.flatMap(({ at }, i) => [i > 0 ? burst[i - 1].at : before, at]);
    const ofBurst = burst.filter((candidate) => candidate !== chosen);
    const theChosen = chosen ? [chosen] : [];
    return [...pinsOf(now.filter(({ terms }) => !terms), 0.012, 4, 1.5),
      ...pinsOf(now.filter(({ kind }) => kind === kValid), 0.02, 8, 2.6),
      ...inFront([makeTube(numbersOf(legs), colourOf("chosen"), 1.5)], 6),
      ...inFront(pinsOf(ofBurst, 0.03, 11, 3), 7),
      ...inFront(pinsOf(theChosen, 0.045, 21, 9, () => rim), 8),
      ...inFront(pinsOf(theChosen, 0.045, 15, 5), 9)];
  }

  /** Of the chosen view, up to the first voxel that held points before. */
  private rays(view: number): three.LineSegments {
    const { densities } = this.model;
    const known = this.model.voxelsKnown(view);
    const [hit, miss] = ["ray_hit", "ray_free"].map((name) =>
      new three.Color(colourOf(name)).toArray());
    const colours: number[] = [];
    for (const { camera, T } of this.flight.camerasInWorld(view)) {
      const origin = new three.Vector3().setFromMatrixPosition(T);
      for (let i = 0; i < kRays[0] * kRays[1]; ++i) {
        const [u, v] = [i % kRays[0], Math.floor(i / kRays[0])]
          .map((k, axis) => 2 * (k + 0.5) / kRays[axis] - 1);
        const way = new three.Vector3(u * Math.tan(camera.fov_x / 2),
          v * Math.tan(camera.fov_y / 2), 1).transformDirection(T);
        const length = densities.firstHit(origin, way, camera.range_m, known);
        const isHit = length < camera.range_m;
        this.rayEnds.push(origin, origin.clone().addScaledVector(way,
          isHit ? length : Math.min(length, this.flight.sight_m)));
        colours.push(...isHit ? [...hit, ...hit] : [...miss, ...miss]);
      }
    }
    return makeLines(numbersOf(this.rayEnds), colours, 0.45);
  }

  /** What the lines of the present decision mean; the counts add up to all of its candidates. */
  kinds(): { colour: string; text: string; means: string; count: number;
    isRejected?: boolean }[] {
    const rays = "Rays end at the first voxel that held points before; those that meet none are "
      + `pale, and drawn to ${number(this.flight.sight_m, 1)} m`;
    const counts = [...Map.groupBy(this.now, ({ kind }) => kind)].sort(([a], [b]) => b - a);
    return counts.map(([kind, { length: count }]) =>
      kind === kChosen ? { colour: cssOf("chosen"), text: "chosen view, and its rays",
        means: rays, count }
      : kind === kKept ? { colour: cssOf("chosen"),
        text: "views of the burst along their line, rays of this one",
        means: "Each is kept for points that those before do not see; they are flown one after "
          + `the other without another decision. ${rays}`, count }
      : kind === kValid ? { colour: rampGradient("score"), text: this.burst.length > 0
        ? "other valid ones, few to many points covered" : "other valid ones, low to high utility",
        means: "They may be flown to, and competed with the chosen one", count }
      : { colour: cssOnPage(reason(kind).light), text: reason(kind).words,
        means: reason(kind).means, count, isRejected: true });
  }

  /** How many were valid, in the words of the replay, and what became of the others. */
  private sum(): (Node | string)[] {
    const { view } = this;
    const v = this.flight.data.views;
    const before = this.now.length - v.candidates[view];
    const competed = this.now.filter(({ terms }) => terms).length;
    const rejected = this.kinds().filter(({ isRejected }) => isRejected);
    const burst = this.burst.length === 0 ? ""
      : `View ${number(v.plan_view[view])} of ${number(this.burst.length)} of the burst planned at `
        + `view ${number(this.flight.planOf(view + 1))}: `;
    return [burst, validWords(this.flight, view),
      before > 0 ? `, and ${number(competed - v.valid[view])} of ${number(before)} sampled before`
        : "",
      ...rejected.flatMap(({ text, means, count }) =>
        ["; ", make("span", { title: means }, `${text}: ${number(count)}`)]), "."];
  }

  /** The decision in words: its rejections, and the best of those that competed. */
  table(): HTMLElement {
    if (this.now.length === 0) return make("p", { class: "fine" }, "No decision chose this view.");
    if (this.burst.length > 0) return this.tableOfBurst();
    const best = this.now.filter(({ terms }) => terms)
      .sort((a, b) => b.terms![0] - a.terms![0]).slice(0, kBest);
    return make("div", {}, make("p", { class: "fine" }, ...this.sum()),
      best.length === 0 ? "" : tableOf("", ["", "Utility", "Information", "Density", "Prediction",
        "Distance factor"], (column) => column > 0, best.map(({ kind, terms }, rank) =>
        [`${rank + 1}${kind === kChosen ? ", chosen" : ""}`, ...Array.from(terms!, significant)]),
      (row) => best[row].kind === kChosen));
  }

  private tableOfBurst(): HTMLElement {
    const isThis = (row: number) => this.burst[row] === this.chosen;
    return make("div", {}, make("p", { class: "fine" }, ...this.sum()),
      tableOf("", ["", "Points covered"], (column) => column > 0, this.burst.map(({ terms }, row) =>
        [`${row + 1}${isThis(row) ? ", this view" : ""}`, number(terms![0])]), isThis));
  }
}

/** Over everything, in that order. */
function inFront(parts: (three.Points | three.Mesh)[], order: number): three.Object3D[] {
  for (const part of parts) {
    part.renderOrder = order;
    Object.assign(part.material, { depthTest: false, transparent: true }); // after what is opaque
  }
  return parts;
}

/** In the order in which they are drawn: the ghost of what is unknown comes last. */
export const kBelievedKinds = ["looked_at", "frontier", "predicted", "unknown"] as const;
type BelievedKind = typeof kBelievedKinds[number];
const kLayers: Record<BelievedKind, string> = { unknown: "unknown", predicted: "predicted",
  frontier: "frontiers", looked_at: "frontiers" };
const kWidths: Record<BelievedKind, number> = { unknown: 1, predicted: 0.8, frontier: 1.02,
  looked_at: 1.04 };

const kFaceNumbers = 18; // of three's box, of its two triangles
/** Which way the box's faces look, as they come. */
const kWays = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];

export class BelievedMarks extends ViewMark {
  private layers: Layers = {};
  private view = -1; // whose decision it is

  constructor(private readonly data: BeliefData) { super(); }

  has(layer: string) {
    return kBelievedKinds.some((kind) => this.data[kind] && kLayers[kind] === layer);
  }

  setLayers(layers: Layers) {
    this.layers = { ...layers };
    this.object.visible = layers.unknown || layers.predicted || layers.frontiers;
  }

  /** Of the decision that chose the last of the first `n` views. */
  protected parts(n: number): three.Object3D[] {
    this.view = n - 1;
    return kBelievedKinds.filter((kind) => this.cells(kind).size > 0)
      .map((kind) => this.mesh(kind, this.cells(kind)));
  }

  protected variant() {
    return kBelievedKinds.map((kind) => Number(this.layers[kLayers[kind]])).join("");
  }

  /** Voxels of the map, of each kind that is shown. */
  counts(): Partial<Record<BelievedKind, number>> {
    return Object.fromEntries(kBelievedKinds
      .filter((kind) => this.data[kind] && this.layers[kLayers[kind]])
      .map((kind) => [kind, this.view < 0 ? 0 : this.data[kind]!.counts[this.view]]));
  }

  /** Edge of the cells that are drawn, where they are larger than the map's voxels; else 0. */
  coarse_m(): number { return this.data.size_m > this.data.map_m ? this.data.size_m : 0; }

  /** Those that are drawn; none of a kind that is not shown. */
  cells(kind: BelievedKind): Set<number> {
    const list = this.data[kind];
    const cells = new Set<number>();
    if (!list || !this.layers[kLayers[kind]] || !list.counts[this.view]) return cells;
    for (let view = list.has_changes ? 0 : this.view; view <= this.view; ++view) {
      for (let i = list.begins[view], end = 0; i < list.begins[view + 1]; i += 2) {
        const first = end + list.runs[i];
        end = first + list.runs[i + 1];
        for (let cell = first; cell < end; ++cell) if (!cells.delete(cell)) cells.add(cell);
      }
    }
    return cells;
  }

  /** A cube a cell, or of what is unknown the faces around all of it, through which one looks. */
  private mesh(kind: BelievedKind, cells: Set<number>): three.Mesh {
    const { low, cells: [nx, ny, nz], size_m } = this.data;
    const isGhost = kind === "unknown";
    const isInside = ([x, y, z]: number[]) => x >= 0 && x < nx && y >= 0 && y < ny
      && z >= 0 && z < nz && cells.has((z * ny + y) * nx + x);
    const width_m = kWidths[kind] * size_m;
    const box = new three.BoxGeometry(width_m, width_m, width_m).toNonIndexed()
      .getAttribute("position").array;
    const places: number[] = [];
    for (const cell of cells) {
      const at = [cell % nx, Math.floor(cell / nx) % ny, Math.floor(cell / (nx * ny))];
      kWays.forEach((way, face) => {
        if (isGhost && isInside(at.map((index, axis) => index + way[axis]))) return;
        for (let i = kFaceNumbers * face; i < kFaceNumbers * (face + 1); ++i) {
          places.push(size_m * (low[i % 3] + at[i % 3] + 0.5) + box[i]);
        }
      });
    }
    const geometry = new three.BufferGeometry()
      .setAttribute("position", new three.Float32BufferAttribute(places, 3));
    return new three.Mesh(geometry, new three.MeshLambertMaterial({ flatShading: true,
      color: colourOf(kind), transparent: isGhost, opacity: isGhost ? 0.25 : 1,
      depthWrite: !isGhost }));
  }
}
