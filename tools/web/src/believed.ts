// For whose sake a view was chosen: the voxels that its rays were to cross, as they were believed
// before, and the frontiers that views were sampled around.
import * as three from "three";
import { colourOf } from "./colours";
import type { BeliefData } from "./data";
import { ViewMark, geometryOf } from "./marks";
import type { Layers } from "./run_scene";

export type BelievedKind = "unknown" | "predicted" | "frontier" | "looked_at";

/** In the order in which they are drawn: the ghost of what is unknown comes last. */
export const kBelievedKinds: BelievedKind[] = ["looked_at", "frontier", "predicted", "unknown"];
const kLayers: Record<BelievedKind, string> = { unknown: "unknown", predicted: "predicted",
  frontier: "frontiers", looked_at: "frontiers" };
const kWidths: Record<BelievedKind, number> = { unknown: 1, predicted: 0.8, frontier: 1.02,
  looked_at: 1.04 };

// Faces towards -x, +x, -y, +y, -z, +z, counter-clockwise from outside; a corner's bits are its
// upper ends along x, y, z.
const kFaces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

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
    return kBelievedKinds.filter((kind) => this.cells(kind).length > 0)
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

  /** Edge of the cells that are drawn, where they are larger than the map's voxels. */
  coarse_m(): number | null { return this.data.size_m > this.data.map_m ? this.data.size_m : null; }

  /** Index along x, y, z of each cell that is drawn. */
  drawn(kind: BelievedKind) { return this.cells(kind).map((cell) => this.indexOf(cell)); }

  /** Ascending; none of a kind that is not shown. */
  private cells(kind: BelievedKind): number[] {
    const list = this.data[kind];
    if (!list || !this.layers[kLayers[kind]] || !list.counts[this.view]) return [];
    const cells = new Set<number>();
    for (let view = list.has_changes ? 0 : this.view; view <= this.view; ++view) {
      for (let i = list.begins[view], end = 0; i < list.begins[view + 1]; i += 2) {
        const first = end + list.runs[i];
        end = first + list.runs[i + 1];
        for (let cell = first; cell < end; ++cell) if (!cells.delete(cell)) cells.add(cell);
      }
    }
    return [...cells].sort((a, b) => a - b);
  }

  private indexOf(cell: number): number[] {
    const { low, cells: [nx, ny] } = this.data;
    return [cell % nx + low[0], Math.floor(cell / nx) % ny + low[1],
      Math.floor(cell / (nx * ny)) + low[2]];
  }

  /** A cube a cell, or of what is unknown the faces around all of it, through which one looks. */
  private mesh(kind: BelievedKind, cells: number[]): three.Mesh {
    const { low, cells: [nx, ny, nz], size_m } = this.data;
    const isGhost = kind === "unknown";
    const inside = new Set(isGhost ? cells : []);
    const isInside = ([x, y, z]: number[]) => x >= 0 && x < nx && y >= 0 && y < ny
      && z >= 0 && z < nz && inside.has((z * ny + y) * nx + x);
    const half = kWidths[kind] / 2;
    const corners: number[] = [];
    const order: number[] = [];
    for (const cell of cells) {
      const at = this.indexOf(cell).map((index, axis) => index - low[axis]);
      kFaces.forEach((face, side) => {
        const beside = at.map((x, axis) => x + (axis === side >> 1 ? 2 * (side & 1) - 1 : 0));
        if (isInside(beside)) return;
        const first = corners.length / 3;
        for (const corner of face) {
          corners.push(...at.map((x, axis) =>
            size_m * (low[axis] + x + 0.5 + (corner >> axis & 1 ? half : -half))));
        }
        order.push(first, first + 1, first + 2, first, first + 2, first + 3);
      });
    }
    const mesh = new three.Mesh(geometryOf(corners, null, order), new three.MeshLambertMaterial({
      flatShading: true,
      color: colourOf(kind), transparent: isGhost, opacity: isGhost ? 0.25 : 1,
      depthWrite: !isGhost }));
    mesh.frustumCulled = false;
    return mesh;
  }
}
