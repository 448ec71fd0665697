// The voxels that hold points, and how many each.
import type { Vector3 } from "three";
import type { VoxelData } from "./data";

/** Of a cell by its index along each axis, 16 bits each; exact in a double. */
export const keyOf = (x: number, y: number, z: number) => ((x + 32768) * 65536 + y + 32768) * 65536
  + z + 32768;

/**
 * How many of the cloud's points each voxel holds at a state of the mission, with a ceiling that
 * leaves out the densest few of the last one.
 */
export class Densities {
  readonly count: Uint32Array; // at this state
  readonly most: number;
  private state = 0; // of how many the gains are in `count`
  private readonly cells = new Map<number, number>();

  constructor(readonly voxels: VoxelData) {
    const { index, gains_after } = voxels;
    this.count = new Uint32Array(index.length / 3);
    this.count.forEach((_, i) =>
      this.cells.set(keyOf(index[3 * i], index[3 * i + 1], index[3 * i + 2]), i));
    this.seek(gains_after.length - 1);
    this.most = this.count.toSorted()[Math.floor(0.98 * (this.count.length - 1))] || 1;
  }

  /** To the counts after `views` views. */
  seek(views: number) {
    for (; this.state <= views; ++this.state) this.add(this.state, 1);
    for (; this.state > views + 1; --this.state) this.add(this.state - 1, -1);
  }

  private add(state: number, sign: number) {
    const { gains, gains_after } = this.voxels;
    const begin = state > 0 ? gains_after[state - 1] : 0;
    for (let i = begin, voxel = 0; i < gains_after[state]; i += 2) {
      voxel += gains[i];
      this.count[voxel] += sign * gains[i + 1];
    }
  }

  /** Middle of a voxel along an axis, in metres. */
  middle(voxel: number, axis: number) {
    return this.voxels.size_m * (this.voxels.index[3 * voxel + axis] + 0.5);
  }

  /** How far a ray goes until it meets one of the first `known` voxels; `far` if it meets none. */
  firstHit(from: Vector3, way: Vector3, far: number, known: number): number {
    const { size_m } = this.voxels;
    for (let t = size_m; t < far; t += 0.4 * size_m) {
      const voxel = this.voxelAt(from.x + t * way.x, from.y + t * way.y, from.z + t * way.z);
      if (voxel >= 0 && voxel < known) return t;
    }
    return far;
  }

  /** Of the voxel in which the point lies; -1 where rounding put it into one without points. */
  voxelAt(x: number, y: number, z: number): number {
    const cell = (c: number) => Math.floor(c / this.voxels.size_m);
    return this.cells.get(keyOf(cell(x), cell(y), cell(z))) ?? -1;
  }
}
