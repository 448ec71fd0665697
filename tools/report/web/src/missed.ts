// Where a run missed most of the true surface: voxels never found, gathered into regions.
import * as three from "three";
import { make, number } from "./dom";
import type { Flight } from "./flight";
import type { RunScene } from "./run_scene";
import { kNeverFound, type TrueSurface } from "./true_surface";

const kCells = 50; // along the structure; voxels in those that touch are one region
const kMostCell_m = 0.5;
const kMostRegions = 6;

export interface Region {
  voxels: number;
  centre: three.Vector3;
  radius_m: number;
}

/** Of the voxels that were never found, the largest first. */
export function missedRegions(surface: TrueSurface): Region[] {
  const all = new three.Box3();
  surface.found.forEach((_, voxel) => all.expandByPoint(surface.centre(voxel)));
  const cell_m = Math.max(2 * surface.size_m,
    Math.min(kMostCell_m, all.getSize(new three.Vector3()).length() / kCells));
  const cells = new Map<string, number[]>();
  const cellOf = (voxel: number) => surface.centre(voxel).divideScalar(cell_m).floor();
  surface.found.forEach((first, voxel) => {
    if (first !== kNeverFound) return;
    const key = cellOf(voxel).toArray().join();
    const cell = cells.get(key);
    if (cell) cell.push(voxel); else cells.set(key, [voxel]);
  });
  const regions: Region[] = [];
  while (cells.size > 0) {
    const open = [cells.keys().next().value!];
    const members: number[] = [];
    while (open.length > 0) {
      const key = open.pop()!;
      const cell = cells.get(key);
      if (!cell) continue;
      cells.delete(key);
      members.push(...cell);
      const [x, y, z] = key.split(",").map(Number);
      for (let i = 0; i < 27; ++i) {
        open.push([x + i % 3 - 1, y + Math.floor(i / 3) % 3 - 1, z + Math.floor(i / 9) - 1].join());
      }
    }
    regions.push(regionOf(surface, members));
  }
  return regions.sort((a, b) => b.voxels - a.voxels);
}

function regionOf(surface: TrueSurface, members: number[]): Region {
  const box = new three.Box3();
  for (const voxel of members) box.expandByPoint(surface.centre(voxel));
  return { voxels: members.length, centre: box.getCenter(new three.Vector3()),
    radius_m: Math.max(box.getSize(new three.Vector3()).length() / 2, surface.size_m) };
}

/** A list of each run's largest regions; a button shows one. Null where all was found. */
export function makeMissedList(scenes: RunScene[],
    show: (region: Region) => void): HTMLElement | null {
  const lists = scenes.filter((scene) => scene.surface).map((scene) => {
    const regions = missedRegions(scene.surface!);
    const all = regions.reduce((sum, region) => sum + region.voxels, 0);
    return regions.length === 0 ? null : make("div", {},
      make("p", { class: "fine" }, scenes.length > 1 ? `${scene.flight.data.label}: ` : "",
        sentence(scene.flight, scene.surface!, all, regions.length)),
      make("ol", { class: "regions" }, ...regions.slice(0, kMostRegions).map((region, i) =>
        make("li", {}, make("button", { type: "button", class: "small",
          click: () => show(region), "aria-label": `Show region ${i + 1}` }, "Show"),
        ` ${number(region.voxels)} voxels, ${number(100 * region.voxels / all, 1)} %, around `
        + region.centre.toArray().map((x) => number(Math.round(10 * x) / 10 + 0, 1)).join(", ")
        + " m"))));
  }).filter((list) => list !== null);
  return lists.length === 0 ? null : make("section", { class: "card again" },
    make("h3", { class: "flush" }, "Where most was missed"), ...lists);
}

function sentence(flight: Flight, surface: TrueSurface, missed: number, regions: number): string {
  return `Never found after ${number(flight.count)} views: ${number(missed)} of `
    + `${number(surface.found.length)} voxels of ${number(surface.size_m, 2)} m, in `
    + `${number(regions)} ${regions === 1 ? "region" : "regions"}.`;
}
