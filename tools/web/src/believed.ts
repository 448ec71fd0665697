// For whose sake a view was chosen: the voxels that its rays were to cross, as they were believed
// before, and the frontiers that views were sampled around.
import * as three from "three";
import { colourOf } from "./colours";
import type { BeliefData } from "./data";
import { ViewMark } from "./marks";
import type { Layers } from "./run_scene";

/** In the order in which they are drawn: the ghost of what is unknown comes last. */
export const kBelievedKinds = ["looked_at", "frontier", "predicted", "unknown"] as const;
export type BelievedKind = typeof kBelievedKinds[number];
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
