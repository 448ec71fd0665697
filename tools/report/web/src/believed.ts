// For whose sake a view was chosen: the voxels that its rays were to cross, as they were believed
// before, and the frontiers that views were sampled around.
import * as three from "three";
import type { BeliefData, BeliefListData, Bytes } from "./data";

export type BelievedKind = "unknown" | "predicted" | "frontier" | "looked_at";
export type BelievedLayer = "unknown" | "predicted" | "frontiers";

/** As in the pictures of candidates and of voxels. */
export const kBelievedColours: Record<BelievedKind, number> = {
  unknown: 0xe69f00, predicted: 0xd5309c, frontier: 0x56b4e9, looked_at: 0x0b5fa5 };

/** In the order in which they are drawn: the ghost of what is unknown comes last. */
const kKinds: BelievedKind[] = ["looked_at", "frontier", "predicted", "unknown"];
const kLayers: Record<BelievedKind, BelievedLayer> = { unknown: "unknown",
  predicted: "predicted", frontier: "frontiers", looked_at: "frontiers" };
const kWidths: Record<BelievedKind, number> = { unknown: 1, predicted: 0.8, frontier: 1.02,
  looked_at: 1.04 };

/** Packed as what changes from one view that has any to the next. */
const kChanging = new Set<BelievedKind>(["frontier"]);

/** Numbers of seven bits a byte, the lowest first (tools/report/belief_pack.hpp). */
function* numbers(bytes: Uint8Array): Generator<number> {
  for (let i = 0, value = 0, scale = 1; i < bytes.length; ++i) {
    value += (bytes[i] & 127) * scale;
    scale *= 128;
    if (bytes[i] >= 128) continue;
    yield value;
    [value, scale] = [0, 1];
  }
}

/** The cells of a view, ascending. */
function cellsOf(bytes: Uint8Array): number[] {
  const cells: number[] = [];
  const all = numbers(bytes);
  for (let end = 0;;) {
    const gap = all.next();
    if (gap.done) return cells;
    const first = end + gap.value;
    end = first + all.next().value!;
    for (let cell = first; cell < end; ++cell) cells.push(cell);
  }
}

// Faces towards -x, +x, -y, +y, -z, +z, counter-clockwise from outside; a corner's bits are its
// upper ends along x, y, z.
const kFaces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

export class BelievedMarks {
  readonly object = new three.Group();
  private readonly lists = new Map<BelievedKind, { runs: Uint8Array; begins: Uint32Array;
    counts: Uint32Array }>();
  private layers: Record<BelievedLayer, boolean> =
    { unknown: false, predicted: false, frontiers: false };
  private shownAt = "";
  private view = -1; // whose decision it is

  constructor(private readonly data: BeliefData, bytes: Bytes) {
    for (const kind of kKinds) {
      const list: BeliefListData | null = data[kind];
      if (list) {
        this.lists.set(kind, { runs: bytes.u8(list.runs), begins: bytes.u32(list.begins),
          counts: bytes.u32(list.counts) });
      }
    }
  }

  has(layer: BelievedLayer) {
    return [...this.lists.keys()].some((kind) => kLayers[kind] === layer);
  }

  setLayers(layers: Record<BelievedLayer, boolean>) {
    this.layers = { unknown: layers.unknown, predicted: layers.predicted,
      frontiers: layers.frontiers };
    this.object.visible = Object.values(this.layers).some((on) => on);
  }

  /** Of the decision that chose the last of the first `n` views. */
  show(n: number) {
    const state = JSON.stringify([n, this.layers]);
    if (state === this.shownAt || !this.object.visible) return;
    this.shownAt = state;
    this.view = n - 1;
    for (const part of this.object.children) (part as three.Mesh).geometry.dispose();
    this.object.clear();
    for (const kind of kKinds) {
      if (!this.layers[kLayers[kind]]) continue;
      const cells = this.cells(kind);
      if (cells.length > 0) this.object.add(this.mesh(kind, cells));
    }
    this.object.traverse((part) => { part.layers.mask = this.object.layers.mask; });
  }

  /** Voxels of the map, of each kind that is shown. */
  counts(): Partial<Record<BelievedKind, number>> {
    return Object.fromEntries([...this.lists].filter(([kind]) => this.layers[kLayers[kind]])
      .map(([kind, { counts }]) => [kind, this.view < 0 ? 0 : counts[this.view]]));
  }

  /** Edge of the cells that are drawn, where they are larger than the map's voxels. */
  coarse_m(): number | null { return this.data.size_m > this.data.map_m ? this.data.size_m : null; }

  /** Index along x, y, z of each cell that is drawn. */
  drawn(kind: BelievedKind): number[][] {
    return this.layers[kLayers[kind]] ? this.cells(kind).map((cell) => this.indexOf(cell)) : [];
  }

  private cells(kind: BelievedKind): number[] {
    const list = this.lists.get(kind);
    if (!list || this.view < 0 || list.counts[this.view] === 0) return [];
    const of = (view: number) =>
      cellsOf(list.runs.subarray(list.begins[view], list.begins[view + 1]));
    if (!kChanging.has(kind)) return of(this.view);
    const cells = new Set<number>();
    for (let view = 0; view <= this.view; ++view) {
      for (const cell of of(view)) if (!cells.delete(cell)) cells.add(cell);
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
    const isInside = (x: number, y: number, z: number) => x >= 0 && x < nx && y >= 0 && y < ny
      && z >= 0 && z < nz && inside.has((z * ny + y) * nx + x);
    const half = kWidths[kind] / 2;
    const corners: number[] = [];
    const order: number[] = [];
    for (const cell of cells) {
      const at = this.indexOf(cell).map((index, axis) => index - low[axis]);
      kFaces.forEach((face, side) => {
        const beside = at.map((x, axis) => x + (axis === side >> 1 ? 2 * (side & 1) - 1 : 0));
        if (isInside(beside[0], beside[1], beside[2])) return;
        const first = corners.length / 3;
        for (const corner of face) {
          corners.push(...at.map((x, axis) =>
            size_m * (low[axis] + x + 0.5 + (corner >> axis & 1 ? half : -half))));
        }
        order.push(first, first + 1, first + 2, first, first + 2, first + 3);
      });
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.Float32BufferAttribute(corners, 3));
    geometry.setIndex(order);
    const material = new three.MeshLambertMaterial({ color: kBelievedColours[kind],
      flatShading: true, transparent: isGhost, opacity: isGhost ? 0.25 : 1, depthWrite: !isGhost });
    const mesh = new three.Mesh(geometry, material);
    mesh.frustumCulled = false;
    return mesh;
  }
}
