// The voxels that hold points, and how many each.
import type { Vector3 } from "three";
import type { Bytes, VoxelData } from "./data";

/**
 * How many of the cloud's points each voxel holds at a state of the mission, with a ceiling that
 * leaves out the densest few of the last one.
 */
export class Densities {
  readonly size: number;
  readonly index: Int16Array;
  readonly count: Uint32Array; // at this state
  readonly most: number;
  private state = 0; // of how many the gains are in `count`
  private readonly step: Uint16Array;
  private readonly points: Uint8Array;
  private readonly gainsAfter: Uint32Array;
  private readonly cells = new Map<number, number>();

  constructor(voxels: VoxelData, bytes: Bytes) {
    this.size = voxels.size_m;
    this.index = bytes.i16(voxels.index);
    this.step = bytes.u16(voxels.gain_step);
    this.points = bytes.u8(voxels.gain_points);
    this.gainsAfter = bytes.u32(voxels.gains_after);
    this.count = new Uint32Array(this.index.length / 3);
    for (let i = 0; i < this.count.length; ++i) {
      const [x, y, z] = this.index.subarray(3 * i, 3 * i + 3);
      this.cells.set(Densities.key(x, y, z), i);
    }
    this.seek(this.gainsAfter.length - 1);
    const sorted = Uint32Array.from(this.count).sort();
    this.most = sorted[Math.floor(0.98 * (sorted.length - 1))] || 1;
  }

  /** To the counts after `views` views. */
  seek(views: number) {
    for (; this.state <= views; ++this.state) this.add(this.state, 1);
    for (; this.state > views + 1; --this.state) this.add(this.state - 1, -1);
  }

  private add(state: number, sign: number) {
    let voxel = 0;
    for (let i = state > 0 ? this.gainsAfter[state - 1] : 0; i < this.gainsAfter[state]; ++i) {
      voxel += this.step[i];
      this.count[voxel] += sign * this.points[i];
    }
  }

  /** Exact in a double: 16 bits an axis. */
  private static key(i: number, j: number, k: number): number {
    return ((i + 32768) * 65536 + j + 32768) * 65536 + k + 32768;
  }

  /**
   * How far a ray goes until it meets one of the first `known` voxels; `far` where it meets none.
   */
  firstHit(from: Vector3, way: Vector3, far: number, known: number): number {
    for (let t = this.size; t < far; t += 0.4 * this.size) {
      const voxel = this.voxelAt(from.x + t * way.x, from.y + t * way.y, from.z + t * way.z);
      if (voxel >= 0 && voxel < known) return t;
    }
    return far;
  }

  /** Of the voxel in which the point lies; -1 where rounding put it into one without points. */
  voxelAt(x: number, y: number, z: number): number {
    const cell = (c: number) => Math.floor(c / this.size);
    return this.cells.get(Densities.key(cell(x), cell(y), cell(z))) ?? -1;
  }
}
