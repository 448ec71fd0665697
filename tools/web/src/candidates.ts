// Why this view: the candidates of the decision that chose it, with what became of each.
import * as three from "three";
import { colourOf, hex, isDark, onPage, ramp, rampGradient, reason } from "./colours";
import type { CandidateData } from "./data";
import { make, number, significant } from "./dom";
import { rangeOf, type Flight } from "./flight";
import { ViewMark, makeDots, makeLines, makeTube } from "./marks";
import { tableOf, validWords } from "./panels";
import type { Model } from "./surfaces";

const kValid = 254; // of a candidate's kind, see page_data.hpp
const kChosen = 255;
const kTermCount = 5; // utility, information, density, prediction, distance
const kBest = 5;
const kRays = [9, 7];

interface Candidate {
  at: three.Vector3;
  yaw: number;
  pitch: number;
  kind: number; // a reason of rejection, kValid or kChosen
  terms: Float32Array | null; // of those that competed
}

export class CandidateMarks extends ViewMark {
  private view = -1; // whose decision it is
  private now: Candidate[] = [];

  /** Rays that meet nothing are drawn as far as `missed_m`, or to the end of a camera's range. */
  constructor(private readonly flight: Flight, private readonly model: Model,
      private readonly data: CandidateData, private readonly missed_m: number) { super(); }

  get count() { return this.now.length; } // drawn

  /** The decision that chose the last of the first `n` views. */
  protected parts(n: number): three.Object3D[] {
    this.view = n - 1;
    this.now = n > 0 ? this.decision(n - 1) : [];
    const hasChosen = this.now.some(({ kind }) => kind === kChosen);
    return this.now.length === 0 ? [] : [...this.pins(), ...hasChosen ? [this.rays(n - 1)] : []];
  }

  private decision(view: number): Candidate[] {
    const { begins, kind: kinds, points, angles, terms } = this.data;
    const all: Candidate[] = [];
    let term = begins[2 * view + 1];
    for (let i = begins[2 * view]; i < begins[2 * view + 2]; ++i) {
      const kind = kinds[i];
      const at = kind >= kValid ? kTermCount * term++ : -1;
      all.push({ at: new three.Vector3().fromArray(points, 3 * i), kind,
        yaw: angles[2 * i], pitch: angles[2 * i + 1],
        terms: at < 0 ? null : terms.subarray(at, at + kTermCount) });
    }
    return all;
  }

  private colourOf({ kind, terms }: Candidate): three.Color {
    if (kind === kChosen) return new three.Color(colourOf("chosen"));
    if (!terms) return onPage(reason(kind).light);
    const values = this.now.filter((other) => other.terms).map((other) => other.terms![0]);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    return ramp("score", (terms[0] - low) / (high - low || 1));
  }

  /** A dot where each stands, and a line the way it looks; the chosen one on a rim, over all. */
  private pins(): three.Object3D[] {
    const extent = this.flight.workspace().size_m;
    const isChosen = ({ kind }: Candidate) => kind === kChosen;
    const rim = new three.Color(isDark() ? 0x000000 : 0xffffff);
    const colour = (candidate: Candidate) => this.colourOf(candidate);
    return [
      ...pinsOf(this.now.filter((c) => c.terms === null), 0.012 * extent, 4, 1.5, colour),
      ...pinsOf(this.now.filter(({ kind }) => kind === kValid), 0.02 * extent, 8, 2.6, colour),
      ...inFront(pinsOf(this.now.filter(isChosen), 0.045 * extent, 21, 9, () => rim), 8),
      ...inFront(pinsOf(this.now.filter(isChosen), 0.045 * extent, 15, 5, colour), 9)];
  }

  /** Of the chosen view, up to the first voxel that held points before. */
  private rays(view: number): three.LineSegments {
    const { densities } = this.model;
    const known = this.model.voxelsKnown(view);
    const positions: number[] = [];
    const colours: number[] = [];
    const [hit, miss] = ["ray_hit", "ray_free"].map((name) =>
      new three.Color(colourOf(name)).toArray());
    for (const { camera, T } of this.flight.camerasInWorld(view)) {
      const origin = new three.Vector3().setFromMatrixPosition(T);
      for (let i = 0; i < kRays[0] * kRays[1]; ++i) {
        const share = [i % kRays[0], Math.floor(i / kRays[0])]
          .map((k, axis) => 2 * (k + 0.5) / kRays[axis] - 1);
        const way = new three.Vector3(share[0] * Math.tan(camera.fov_x / 2),
          share[1] * Math.tan(camera.fov_y / 2), 1).transformDirection(T);
        const length = densities?.firstHit(origin, way, camera.range_m, known) ?? camera.range_m;
        const isHit = length < camera.range_m;
        const end = origin.clone().addScaledVector(way,
          isHit ? length : Math.min(length, this.missed_m));
        positions.push(...origin.toArray(), ...end.toArray());
        colours.push(...isHit ? [...hit, ...hit] : [...miss, ...miss]);
      }
    }
    const rays = makeLines(positions, colours, 0.45);
    rays.name = "rays";
    return rays;
  }

  /** Where those of the present decision stand, x y z each. */
  drawn(): number[] { return this.now.flatMap(({ at }) => at.toArray()); }

  /** Ends of the chosen view's rays, x y z each. */
  rayEnds(): number[] {
    const rays = this.object.children.find((part) => part.name === "rays") as three.LineSegments;
    return [...rays?.geometry.getAttribute("position").array ?? []];
  }

  /** What the lines of the present decision mean; the counts add up to all of its candidates. */
  kinds(): { colour: string; text: string; means: string; count: number;
    isRejected?: boolean }[] {
    const reasons = new Map<number, number>();
    for (const { kind } of this.now) reasons.set(kind, (reasons.get(kind) ?? 0) + 1);
    const range_m = rangeOf(this.flight.data.cameras);
    return [...reasons].sort(([a], [b]) => b - a).map(([kind, count]) =>
      kind === kChosen ? { colour: hex(colourOf("chosen")), text: "chosen view, and its rays",
        means: "Rays end at the first voxel that held points before; those that meet none are pale, "
          + `and drawn to ${number(Math.min(this.missed_m, range_m), 1)} m`, count }
      : kind === kValid ? { colour: rampGradient("score"),
        text: "other valid ones, low to high utility",
        means: "They may be flown to, and competed with the chosen one", count }
      : { colour: `#${onPage(reason(kind).light).getHexString()}`, text: reason(kind).words,
        means: reason(kind).means, count, isRejected: true });
  }

  /** How many were valid, in the words of the replay, and what became of the others. */
  private sum(): (Node | string)[] {
    const { view } = this;
    const v = this.flight.data.views;
    const before = this.now.length - v.candidates[view];
    const competed = this.now.filter(({ terms }) => terms).length;
    const rejected = this.kinds().filter(({ isRejected }) => isRejected);
    return [validWords(this.flight, view),
      before > 0 ? `, and ${number(competed - v.valid[view])} of ${number(before)} sampled before`
        : "",
      ...rejected.flatMap(({ text, means, count }) =>
        ["; ", make("span", { title: means }, `${text}: ${number(count)}`)]), "."];
  }

  /** The decision in words: its rejections, and the best of those that competed. */
  table(): HTMLElement {
    if (this.now.length === 0) return make("p", { class: "fine" }, "No decision chose this view.");
    const best = this.now.filter((candidate) => candidate.terms)
      .sort((a, b) => b.terms![0] - a.terms![0]).slice(0, kBest);
    const row = (candidate: Candidate, rank: number) => make("tr",
      { class: candidate.kind === kChosen ? "ours" : "" },
      make("td", {}, candidate.kind === kChosen ? `${rank + 1}, chosen` : `${rank + 1}`),
      ...Array.from(candidate.terms!, (value) => make("td", { class: "number" },
        significant(value))));
    return make("div", {}, make("p", { class: "fine" }, ...this.sum()),
      best.length === 0 ? "" : tableOf("", ["", "Utility", "Information", "Density", "Prediction",
        "Distance factor"], (column) => column > 0, best.map(row)));
  }
}

function pinsOf(all: Candidate[], length: number, dot_px: number, line_px: number,
    colourOf: (candidate: Candidate) => three.Color): [three.Points, three.Object3D] {
  const ends = all.flatMap(({ at, yaw, pitch }) => [...at.toArray(),
    at.x + length * Math.cos(yaw) * Math.cos(pitch),
    at.y + length * Math.sin(yaw) * Math.cos(pitch), at.z - length * Math.sin(pitch)]);
  const colours = all.map((candidate) => colourOf(candidate).toArray());
  return [makeDots(all.flatMap(({ at }) => at.toArray()), colours.flat(), dot_px),
    makeTube(ends, colours.flatMap((rgb) => [...rgb, ...rgb]), line_px)];
}

/** Over everything, in that order. */
function inFront(parts: three.Object3D[], order: number): three.Object3D[] {
  for (const part of parts) {
    part.renderOrder = order;
    const material = (part as three.Mesh).material as three.Material;
    material.depthTest = false;
    material.transparent = true; // drawn after what is opaque
  }
  return parts;
}
