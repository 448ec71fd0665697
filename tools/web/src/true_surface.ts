// The voxels of the true surface: found by a run so far, missed, or found by another run alone; and
// where most was missed: cells of which the half was never found, gathered into regions. A voxel
// missed here and there is nowhere to look at.
import { Box3, MathUtils, Sphere, Vector3 } from "three";
import { colourOf, rampHex } from "./colours";
import type { SurfaceData } from "./data";
import { make, measure, number } from "./dom";
import type { Flight } from "./flight";
import { ofLabel } from "./panels";
import type { RunScene } from "./run_scene";
import type { SplatSource } from "./painter";
import { keyOf } from "./surfaces";

const kNeverFound = 0xffff;
const kNearer = 2; // voxels that missed ones lie before where they are, so that no point hides them

/** Found by a run of the same structure so far, after `views` views. */
interface FoundSoFar { found: Uint16Array; views: number }

export class TrueSurface {
  readonly size_m: number;
  readonly voxels: Int16Array; // x y z index each
  readonly centres: Float64Array; // of them, x y z each, in metres
  isByOrder = false; // coloured by the view that found it
  private now = 0; // views
  private shows = { found: false, missed: false };
  private others: FoundSoFar[] = [];

  /** `found`: of each voxel after how many of `views` it was found, or kNeverFound. */
  constructor(data: SurfaceData, readonly found: Uint16Array, private readonly views: number) {
    this.size_m = data.size_m;
    this.voxels = data.index;
    this.centres = Float64Array.from(data.index, (index) => data.size_m * (index + 0.5));
  }

  setLayers(found: boolean, missed: boolean) { this.shows = { found, missed }; }

  isVisible() { return this.shows.found || this.shows.missed; }

  /** After `n` views of this run; what other runs found by then is told from what none did. */
  show(n: number, others: FoundSoFar[]) { [this.now, this.others] = [n, others]; }

  /** The voxels that are shown. */
  splats(): SplatSource[] {
    const { now, found, isByOrder } = this;
    const [ofFound, missed, onlyOther] = ["found", isByOrder ? "missed_in_order" : "missed",
      "only_other"].map(colourOf);
    const foundColour = (i: number) => (found[i] > now ? -1
      : isByOrder ? rampHex("path", found[i] / Math.max(1, this.views)) : ofFound);
    const missedColour = (i: number) => (found[i] <= now ? -1
      : this.isFoundByOther(i) ? onlyOther : missed);
    const all = { places: this.centres, count: found.length, size_m: 1.3 * this.size_m,
      most_px: 64, isRound: false, largerFrom: Infinity };
    return [...this.shows.found
      ? [{ ...all, least_px: 1.6, nearer_m: 0, colourOf: foundColour }] : [],
    ...this.shows.missed ? [{ ...all, least_px: 2.5, nearer_m: kNearer * this.size_m,
      colourOf: missedColour }] : []];
  }

  centre(voxel: number) { return new Vector3().fromArray(this.centres, 3 * voxel); }

  isShown(voxel: number): boolean {
    return this.found[voxel] <= this.now ? this.shows.found : this.shows.missed;
  }

  private isFoundByOther(voxel: number) {
    return this.others.some(({ found, views }) => found[voxel] <= views);
  }
}

const kCells = 50; // along the structure; those that touch are one region
const kMostCell_m = 0.5;
const kMostRegions = 6;
const kLeastSize_m = 0.05; // of voxels of the true surface, where the page has room for them
const kLeastShare = 0.01; // of all that was missed

/** The voxels that were never found, by the cells of whose voxels they are at least the half. */
function missedCells({ voxels, centres, found, size_m }: TrueSurface): Map<number, number[]> {
  const length_m = new Box3().setFromArray(centres).getSize(new Vector3()).length();
  const span = Math.max(2, Math.round(Math.min(kMostCell_m, length_m / kCells) / size_m));
  const cell = (index: number) => Math.floor(index / span);
  const cells = Map.groupBy(found.keys(), (i) =>
    keyOf(cell(voxels[3 * i]), cell(voxels[3 * i + 1]), cell(voxels[3 * i + 2])));
  for (const [key, members] of cells) {
    const missed = members.filter((i) => found[i] === kNeverFound);
    if (2 * missed.length < members.length) cells.delete(key); else cells.set(key, missed);
  }
  return cells;
}

/** Voxels of such cells that touch each other; the region with most voxels first. */
function missedRegions(surface: TrueSurface): number[][] {
  const cells = missedCells(surface);
  const around = Array.from({ length: 27 }, (_, i) =>
    keyOf(i % 3 - 1, Math.floor(i / 3) % 3 - 1, Math.floor(i / 9) - 1) - keyOf(0, 0, 0));
  const regions: number[][] = [];
  for (const begin of cells.keys()) {
    const region: number[] = [];
    for (const open = [begin]; open.length > 0;) {
      const key = open.pop()!;
      region.push(...cells.get(key) ?? []);
      if (cells.delete(key)) open.push(...around.map((step) => key + step));
    }
    regions.push(region);
  }
  return regions.sort((a, b) => b.length - a.length);
}

/** Shows a region in the 3D view, from `back` of it. */
type ShowRegion = (scene: RunScene, region: Sphere, back: Vector3) => void;

/** A list of each run's largest regions; a button shows one. Null where all was found. */
export function makeMissedList(scenes: RunScene[], show: ShowRegion): HTMLElement | null {
  const lists = scenes.flatMap((scene) => scene.surface ? listOf(scene, scene.surface,
    ofLabel(scenes, scene.flight.data), show) ?? [] : []);
  return lists.length === 0 ? null : make("section", { class: "card again" },
    make("h3", {}, "Where most was missed"),
    make("div", { class: "missed-runs" }, ...lists));
}

function listOf(scene: RunScene, surface: TrueSurface, label: string, show: ShowRegion) {
  const all = surface.found.filter((first) => first === kNeverFound).length;
  if (all === 0) return null;
  const regions = missedRegions(surface).filter(({ length }) => length >= kLeastShare * all);
  return make("div", {},
    make("p", { class: "fine" }, label, sentence(scene.flight, surface, all, regions.length)),
    make("ol", { class: "regions" }, ...regions.slice(0, kMostRegions).map((region, i) => {
      const box = new Box3().setFromPoints(region.map((voxel) => surface.centre(voxel)));
      const { center, radius } = box.getBoundingSphere(new Sphere());
      const around = new Sphere(center, Math.max(radius, surface.size_m));
      return make("li", {}, make("button", { class: "small", "aria-label": `Show region ${i + 1}`,
        click: () => show(scene, around, openSide(surface, region)) }, "Show"),
      ` ${number(region.length)} voxels, ${number(100 * region.length / all, 1)} % of them, around `
        + place(center));
    })));
}

/** "x −0.1, y 0.0, z 0.3 m" */
const place = (at_m: Vector3) => measure(at_m.toArray().map((x, axis) =>
  `${"xyz"[axis]}\u00a0${number(Math.round(10 * x) / 10 + 0, 1).replace("-", "\u2212")}`).join(", "), "m");

function sentence(flight: Flight, surface: TrueSurface, missed: number, regions: number): string {
  return `Never found after ${number(flight.count)} views: ${number(missed)} of `
    + `${number(surface.found.length)} voxels of ${measure(number(surface.size_m, 2), "m")}`
    + (surface.size_m > kLeastSize_m ? `, as the page cannot carry all of ${kLeastSize_m} m, by which `
      + "coverage is counted. " : ". ")
    + (regions === 0 ? "They lie here and there." : `${number(regions)} `
      + `${regions === 1 ? "region was" : "regions were"} missed for the most part`
      + `${regions > kMostRegions ? "; the largest are" : ""}:`);
}

const kAzimuths = 24;
const kElevations_rad = [0.45, 0.8, 0.1, 1.2]; // the first of equal ones is taken
const kTried = 80; // voxels, at most
const kClear = 2.5; // voxels around one that do not count: its neighbours are surface, too
const kFar = 60; // voxels, beyond which nothing stands in the way

/** A direction from the middle of the voxels, of those from which most are seen. */
function openSide({ voxels }: TrueSurface, members: number[]): Vector3 {
  const solid = new Set<number>();
  for (let i = 0; i < voxels.length; i += 3) {
    solid.add(keyOf(voxels[i], voxels[i + 1], voxels[i + 2]));
  }
  const at = new Vector3();
  const isOpen = (voxel: number, way: Vector3) => {
    for (let t = kClear; t < kFar; ++t) {
      at.fromArray(voxels, 3 * voxel).addScaledVector(way, t).round();
      if (solid.has(keyOf(at.x, at.y, at.z))) return false;
    }
    return true;
  };
  const every = Math.ceil(members.length / kTried);
  const tried = members.filter((_, i) => i % every === 0);
  const ways = kElevations_rad.flatMap((elevation) => Array.from({ length: kAzimuths }, (_, i) => {
    const azimuth = MathUtils.degToRad(360 * i / kAzimuths);
    return new Vector3(Math.cos(azimuth), Math.sin(azimuth), Math.tan(elevation)).normalize();
  }));
  const seen = ways.map((way) => tried.filter((voxel) => isOpen(voxel, way)).length);
  return ways[seen.indexOf(Math.max(...seen))];
}
