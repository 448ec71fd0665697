// Why this view: the candidates of the decision that chose it, with what became of each.
import * as three from "three";
import { isDark, ramp, rampGradient } from "./colours";
import type { CandidateData } from "./data";
import { make, number } from "./dom";
import type { Flight } from "./flight";
import { makeTube } from "./marks";
import type { Model } from "./surfaces";

const kValid = 254;
const kChosen = 255;
const kChosenColour = 0xd5420a;
const kRayColour = 0xe08a2e;
const missColour = () => (isDark() ? 0x54483a : 0xecd9c6); // of rays that meet nothing
/** Of a rejection; on a dark page those of the pictures would drown. */
const reasonColour = (ofPictures: number) => {
  const colour = new three.Color(ofPictures);
  const { h, s, l } = colour.getHSL({ h: 0, s: 0, l: 0 }, three.SRGBColorSpace);
  return isDark() ? colour.setHSL(h, s, Math.max(l, 0.55), three.SRGBColorSpace) : colour;
};
const kTermCount = 5; // utility, information, density, prediction, distance
const kBest = 5;
const kRays = [9, 7];

const hex = (colour: number) => `#${colour.toString(16).padStart(6, "0")}`;

interface Candidate {
  at: three.Vector3;
  yaw: number;
  pitch: number;
  kind: number; // a reason of rejection, kValid or kChosen
  terms: Float32Array | null; // of those that competed
}

export class CandidateMarks {
  readonly object = new three.Group();
  count = 0; // drawn
  private readonly places: Float32Array;
  private readonly angles: Float32Array; // yaw and pitch each
  private readonly kindOf: Uint8Array;
  private readonly terms: Float32Array; // of those that competed, one after the other
  private readonly begins: Uint32Array; // of each view's decision, and the end
  private readonly termsBefore: Uint32Array; // how many competed before each view's decision
  private shownAt = -1;
  private now: Candidate[] = [];

  constructor(private readonly flight: Flight, private readonly model: Model,
      private readonly data: CandidateData) {
    const { bytes } = flight;
    this.places = bytes.points(data.points);
    this.angles = bytes.f32(data.angles);
    this.kindOf = bytes.u8(data.kind);
    this.terms = bytes.f32(data.terms);
    this.begins = bytes.u32(data.begins);
    this.termsBefore = new Uint32Array(this.begins.length);
    for (let view = 0, competed = 0, i = 0; view < this.begins.length; ++view) {
      for (; i < this.begins[view]; ++i) if (this.kindOf[i] >= kValid) ++competed;
      this.termsBefore[view] = competed;
    }
  }

  /** The decision that chose the last of the first `n` views. */
  show(n: number) {
    if (n === this.shownAt || !this.object.visible) return;
    this.shownAt = n;
    for (const part of this.object.children) (part as three.Mesh).geometry.dispose();
    this.object.clear();
    this.now = n > 0 ? this.decision(n - 1) : [];
    this.count = this.now.length;
    if (this.count === 0) return;
    this.object.add(...this.pins());
    const chosen = this.now.find((candidate) => candidate.kind === kChosen);
    if (chosen) this.object.add(this.rays(n - 1));
    this.object.traverse((part) => { part.layers.mask = this.object.layers.mask; });
  }

  private decision(view: number): Candidate[] {
    const all: Candidate[] = [];
    let term = this.termsBefore[view];
    for (let i = this.begins[view]; i < this.begins[view + 1]; ++i) {
      const kind = this.kindOf[i];
      const at = kind >= kValid ? kTermCount * term++ : -1;
      all.push({ at: new three.Vector3().fromArray(this.places, 3 * i), kind,
        yaw: this.angles[2 * i], pitch: this.angles[2 * i + 1],
        terms: at < 0 ? null : this.terms.subarray(at, at + kTermCount) });
    }
    return all;
  }

  private colourOf({ kind, terms }: Candidate): three.Color {
    if (kind === kChosen) return new three.Color(kChosenColour);
    if (!terms) return reasonColour(this.data.reasons[kind]?.colour ?? 0x888888);
    const values = this.now.filter((other) => other.terms).map((other) => other.terms![0]);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const [r, g, b] = ramp("amount", (terms[0] - low) / (high - low || 1));
    return new three.Color().setRGB(r / 255, g / 255, b / 255, three.SRGBColorSpace);
  }

  /** A dot where each stands, and a line the way it looks. */
  private pins(): three.Object3D[] {
    const { min, max } = this.flight.data.workspace;
    const extent = new three.Vector3(...min).distanceTo(new three.Vector3(...max));
    const kinds = [(c: Candidate) => c.terms === null, (c: Candidate) => c.kind === kValid,
      (c: Candidate) => c.kind === kChosen];
    return kinds.flatMap((isOne, rank) => {
      const all = this.now.filter(isOne);
      const length = [0.012, 0.02, 0.03][rank] * extent;
      const ends = all.flatMap(({ at, yaw, pitch }) => [...at.toArray(),
        at.x + length * Math.cos(yaw) * Math.cos(pitch),
        at.y + length * Math.sin(yaw) * Math.cos(pitch), at.z - length * Math.sin(pitch)]);
      const colours = all.map((candidate) => this.colourOf(candidate).toArray());
      const dots = new three.BufferGeometry().setFromPoints(all.map(({ at }) => at));
      dots.setAttribute("color", new three.Float32BufferAttribute(colours.flat(), 3));
      const points = new three.Points(dots, new three.PointsMaterial({ vertexColors: true,
        size: [4, 8, 13][rank], sizeAttenuation: false }));
      points.frustumCulled = false;
      return [points, makeTube(new Float32Array(ends),
        new Float32Array(colours.flatMap((rgb) => [...rgb, ...rgb])), [1.5, 2.6, 4.5][rank], 1)];
    });
  }

  /** Of the chosen view, up to the first voxel that held points before. */
  private rays(view: number): three.LineSegments {
    const { densities } = this.model;
    const { p, q } = this.flight.viewPose(view);
    const known = this.model.voxelsKnown(view);
    const positions: number[] = [];
    const colours: number[] = [];
    for (const camera of this.flight.camerasAt(view)) {
      const T = new three.Matrix4().fromArray(camera.T_body_camera);
      const origin = new three.Vector3().setFromMatrixPosition(T).applyQuaternion(q).add(p);
      for (let i = 0; i < kRays[0] * kRays[1]; ++i) {
        const share = [i % kRays[0], Math.floor(i / kRays[0])]
          .map((k, axis) => 2 * (k + 0.5) / kRays[axis] - 1);
        const way = new three.Vector3(share[0] * Math.tan(camera.fov_x / 2),
          share[1] * Math.tan(camera.fov_y / 2), 1).transformDirection(T).applyQuaternion(q);
        const length = densities?.firstHit(origin, way, camera.range_m, known) ?? camera.range_m;
        const end = origin.clone().addScaledVector(way, length);
        positions.push(...origin.toArray(), ...end.toArray());
        const colour = new three.Color(length < camera.range_m ? kRayColour : missColour())
          .toArray();
        colours.push(...colour, ...colour);
      }
    }
    return lines(positions, colours);
  }

  /** What the lines of the present decision mean; the counts add up to all of its candidates. */
  kinds(): { colour: string; text: string; count: number }[] {
    const reasons = new Map<number, number>();
    for (const { kind } of this.now) reasons.set(kind, (reasons.get(kind) ?? 0) + 1);
    return [...reasons].sort(([a], [b]) => b - a).map(([kind, count]) =>
      kind === kChosen ? { colour: hex(kChosenColour), text: "chosen, and its rays", count }
      : kind === kValid ? { colour: rampGradient("amount"),
        text: "other valid ones, low to high utility", count }
      : { colour: `#${reasonColour(this.data.reasons[kind].colour).getHexString()}`,
        text: this.data.reasons[kind].words, count });
  }

  /** How many were valid, and what became of the others. */
  private sum(): string {
    const competed = this.now.filter(({ terms }) => terms).length;
    const hasChosen = this.now.some(({ kind }) => kind === kChosen);
    const rejected = this.kinds()
      .filter(({ text }) => this.data.reasons.some((reason) => reason.words === text));
    return [`valid: ${number(competed)}${hasChosen ? ", with the chosen one" : ""}`,
      ...rejected.map(({ text, count }) => `${text}: ${number(count)}`)].join("; ");
  }

  /** The decision in words: its rejections, and the best of those that competed. */
  table(): HTMLElement {
    if (this.now.length === 0) return make("p", { class: "fine" }, "No decision chose this view.");
    const best = this.now.filter((candidate) => candidate.terms)
      .sort((a, b) => b.terms![0] - a.terms![0]).slice(0, kBest);
    const head = ["", "Utility", "Information", "Density", "Prediction", "Distance factor"];
    const row = (candidate: Candidate, rank: number) => make("tr",
      { class: candidate.kind === kChosen ? "ours" : "" },
      make("td", {}, candidate.kind === kChosen ? `${rank + 1}, chosen` : `${rank + 1}`),
      ...Array.from(candidate.terms!, (value) => make("td", { class: "number" },
        value.toLocaleString("en-US", { maximumSignificantDigits: 4 }))));
    return make("div", {},
      make("p", { class: "fine" },
        `Candidates of all samplers that were asked: ${number(this.now.length)}; ${this.sum()}.`),
      best.length === 0 ? "" : make("div", { class: "card scroll" }, make("table", {},
        make("thead", {}, make("tr", {}, ...head.map((name, i) =>
          make("th", { scope: "col", class: i > 0 ? "number" : "" }, name)))),
        make("tbody", {}, ...best.map(row)))));
  }
}

function lines(positions: number[], colours: number[]): three.LineSegments {
  const geometry = new three.BufferGeometry();
  geometry.setAttribute("position", new three.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("color", new three.Float32BufferAttribute(colours, 3));
  const segments = new three.LineSegments(geometry,
    new three.LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.45,
      depthWrite: false }));
  segments.frustumCulled = false;
  return segments;
}
