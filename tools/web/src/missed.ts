// Where a run missed most of the true surface: cells of which it never found the half, gathered
// into regions. A voxel missed here and there is nowhere to look at.
import * as three from "three";
import { make, measure, number } from "./dom";
import type { Flight } from "./flight";
import type { RunScene } from "./run_scene";
import { keyOf } from "./densities";
import { kNeverFound, type TrueSurface } from "./true_surface";

const kCells = 50; // along the structure; those that touch are one region
const kMostCell_m = 0.5;
const kMostRegions = 6;
const kLeastSize_m = 0.05; // of voxels of the true surface, where the page has room for them
const kLeastShare = 0.01; // of all that was missed

export interface Region {
  voxels: number[];
  centre: three.Vector3;
  radius_m: number;
}

/** The cell of a key. */
const cellOf = (key: number) => [Math.floor(key / 65536 ** 2) - 32768,
  Math.floor(key / 65536) % 65536 - 32768, key % 65536 - 32768];

/** How many voxels of the surface a cell spans along each axis. */
function cellSpan(surface: TrueSurface): number {
  const { voxels, size_m } = surface;
  const [least, most] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  voxels.forEach((index, i) => {
    least[i % 3] = Math.min(least[i % 3], index);
    most[i % 3] = Math.max(most[i % 3], index);
  });
  const length = size_m * Math.hypot(...most.map((index, axis) => index - least[axis]));
  return Math.max(2, Math.round(Math.min(kMostCell_m, length / kCells) / size_m));
}

/** The voxels that were never found, by the cells of whose voxels they are at least the half. */
function missedCells(surface: TrueSurface): Map<number, number[]> {
  const { voxels, found } = surface;
  const span = cellSpan(surface);
  const cells = new Map<number, number[]>();
  const sizes = new Map<number, number>();
  for (let i = 0; i < found.length; ++i) {
    const key = keyOf(Math.floor(voxels[3 * i] / span), Math.floor(voxels[3 * i + 1] / span),
      Math.floor(voxels[3 * i + 2] / span));
    sizes.set(key, (sizes.get(key) ?? 0) + 1);
    if (found[i] !== kNeverFound) continue;
    const cell = cells.get(key);
    if (cell) cell.push(i); else cells.set(key, [i]);
  }
  for (const [key, cell] of cells) if (2 * cell.length < sizes.get(key)!) cells.delete(key);
  return cells;
}

/** Of such cells those that touch; the region with most voxels first. */
export function missedRegions(surface: TrueSurface): Region[] {
  const cells = missedCells(surface);
  const regions: Region[] = [];
  while (cells.size > 0) {
    const open: number[] = [cells.keys().next().value!];
    const members: number[] = [];
    while (open.length > 0) {
      const key = open.pop()!;
      const cell = cells.get(key);
      if (!cell) continue;
      cells.delete(key);
      members.push(...cell);
      const [x, y, z] = cellOf(key);
      for (let i = 0; i < 27; ++i) {
        open.push(keyOf(x + i % 3 - 1, y + Math.floor(i / 3) % 3 - 1, z + Math.floor(i / 9) - 1));
      }
    }
    regions.push(regionOf(surface, members));
  }
  return regions.sort((a, b) => b.voxels.length - a.voxels.length);
}

function regionOf(surface: TrueSurface, members: number[]): Region {
  const box = new three.Box3();
  for (const voxel of members) box.expandByPoint(surface.centre(voxel));
  return { voxels: members, centre: box.getCenter(new three.Vector3()),
    radius_m: Math.max(box.getSize(new three.Vector3()).length() / 2, surface.size_m) };
}

/** A list of each run's largest regions; a button shows one. Null where all was found. */
export function makeMissedList(scenes: RunScene[],
    show: (scene: RunScene, region: Region, back: three.Vector3) => void): HTMLElement | null {
  const lists = scenes.filter((scene) => scene.surface).map((scene) => {
    const regions = missedRegions(scene.surface!);
    const all = scene.surface!.found.filter((first) => first === kNeverFound).length;
    const large = regions.filter((region) => region.voxels.length >= kLeastShare * all);
    return all === 0 ? null : make("div", {},
      make("p", { class: "fine" }, scenes.length > 1 ? `${scene.flight.data.label}: ` : "",
        sentence(scene.flight, scene.surface!, all, large.length)),
      make("ol", { class: "regions" }, ...large.slice(0, kMostRegions).map((region, i) =>
        make("li", {}, make("button", { type: "button", class: "small",
          click: () => show(scene, region, openSide(scene.surface!, region.voxels)),
          "aria-label": `Show region ${i + 1}` }, "Show"),
        ` ${number(region.voxels.length)} voxels, `
        + `${number(100 * region.voxels.length / all, 1)} % of them, around `
        + place(region.centre)))));
  }).filter((list) => list !== null);
  return lists.length === 0 ? null : make("section", { class: "card again" },
    make("h3", { class: "flush" }, "Where most was missed"),
    make("div", { class: "missed-runs" }, ...lists));
}

/** "x −0.1, y 0.0, z 0.3 m" */
const place = (at_m: three.Vector3) => measure(at_m.toArray().map((x, axis) =>
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

// ---- from where a part of the true surface is to be seen best

const kAzimuths = 24;
const kElevations_rad = [0.45, 0.8, 0.1, 1.2]; // the first of equal ones is taken
const kTried = 80; // voxels, at most
const kClear = 2.5; // voxels around one that do not count: its neighbours are surface, too
const kFar = 60; // voxels, beyond which nothing stands in the way

/** A direction from the middle of the voxels, of those from which most are seen. */
function openSide(surface: TrueSurface, members: number[]): three.Vector3 {
  const solid = solidCells(surface);
  const every = Math.ceil(members.length / kTried);
  const tried = members.filter((_, i) => i % every === 0);
  let best = { seen: -1, way: new three.Vector3() };
  for (const elevation of kElevations_rad) {
    for (let i = 0; i < kAzimuths; ++i) {
      const azimuth = 2 * Math.PI * i / kAzimuths;
      const way = new three.Vector3(Math.cos(elevation) * Math.cos(azimuth),
        Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation));
      const seen = tried.filter((voxel) => isOpen(surface, solid, voxel, way)).length;
      if (seen > best.seen) best = { seen, way };
    }
  }
  return best.way;
}

function solidCells({ voxels }: TrueSurface): Set<number> {
  const cells = new Set<number>();
  for (let i = 0; i < voxels.length; i += 3) {
    cells.add(keyOf(voxels[i], voxels[i + 1], voxels[i + 2]));
  }
  return cells;
}

function isOpen({ voxels }: TrueSurface, solid: Set<number>, voxel: number, way: three.Vector3): boolean {
  const at = [0, 1, 2].map((axis) => voxels[3 * voxel + axis]);
  for (let t = kClear; t < kFar; ++t) {
    if (solid.has(keyOf(...way.toArray().map((w, axis) =>
      Math.round(at[axis] + t * w)) as [number, number, number]))) return false;
  }
  return true;
}
