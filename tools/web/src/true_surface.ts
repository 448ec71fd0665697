// The voxels of the true surface: found by a run so far, missed, or found by another run alone.
import * as three from "three";
import { colourOf, rampAt, rampTable } from "./colours";
import type { SurfaceData } from "./data";
import { bgr, type SplatSource } from "./splats";

export const kNeverFound = 0xffff;
const kNearer = 2; // voxels that missed ones lie before where they are, so that no point hides them

export class TrueSurface {
  readonly size_m: number;
  readonly voxels: Int16Array; // x y z index each
  isByOrder = false; // coloured by the view that found it
  private now = 0; // views
  private shows = { found: false, missed: false };
  private others: TrueSurface[] = [];
  private readonly foundByOther: Uint8Array; // of each voxel whether
  private othersAt = ""; // after how many views of each of them

  /** `found`: of each voxel after how many of `views` it was found, or kNeverFound. */
  constructor(data: SurfaceData, readonly found: Uint16Array, private readonly count: number) {
    this.size_m = data.size_m;
    this.voxels = data.index;
    this.foundByOther = new Uint8Array(found.length);
  }

  setLayers(found: boolean, missed: boolean) { this.shows = { found, missed }; }

  isVisible() { return this.shows.found || this.shows.missed; }

  /** What other runs of the same structure found is told from what none did. */
  compareWith(others: TrueSurface[]) {
    this.others = others;
    this.othersAt = "not yet";
  }

  /** After `n` views of this run, and so many of each of the others. */
  show(n: number, ofOthers: number[]) {
    this.now = n;
    if (!this.isVisible() || this.othersAt === ofOthers.join()) return;
    this.othersAt = ofOthers.join();
    for (let i = 0; i < this.found.length; ++i) {
      this.foundByOther[i] = Number(this.others.some(({ found }, k) => found[i] <= ofOthers[k]));
    }
  }

  /** The voxels that are shown. */
  splats(): SplatSource[] {
    const { now, found, size_m } = this;
    const colour = (name: string) => bgr(colourOf(name));
    const [ofFound, missed, onlyOther] = [colour("found"),
      colour(this.isByOrder ? "missed_in_order" : "missed"), colour("only_other")];
    const table = this.isByOrder ? rampTable("path") : null;
    const foundColour = (i: number) => {
      if (found[i] > now || !table) return found[i] > now ? -1 : ofFound;
      const at = rampAt(found[i] / Math.max(1, this.count));
      return table[at] | table[at + 1] << 8 | table[at + 2] << 16;
    };
    const missedColour = (i: number) => (found[i] <= now ? -1
      : this.foundByOther[i] ? onlyOther : missed);
    const all = { places: this.voxels, count: found.length, size_m: 1.3 * size_m,
      most_px: 64, isRound: false, largerFrom: Infinity,
      toWorld: new three.Matrix4().makeScale(size_m, size_m, size_m)
        .multiply(new three.Matrix4().makeTranslation(0.5, 0.5, 0.5)) };
    return [...this.shows.found ? [{ ...all, least_px: 1.6, colourOf: foundColour }] : [],
      ...this.shows.missed ? [{ ...all, least_px: 2.5, nearer_m: kNearer * size_m,
        colourOf: missedColour }] : []];
  }

  /** How many voxels there are of each kind, as they are shown. */
  counts(): { found: number; missed: number; onlyOther: number } {
    const counts = { found: 0, missed: 0, onlyOther: 0 };
    this.found.forEach((first, i) => {
      ++counts[first <= this.now ? "found" : this.foundByOther[i] ? "onlyOther" : "missed"];
    });
    return counts;
  }

  centre(voxel: number): three.Vector3 {
    return new three.Vector3().fromArray(this.voxels, 3 * voxel).addScalar(0.5)
      .multiplyScalar(this.size_m);
  }

  isShown(voxel: number): boolean {
    return this.found[voxel] <= this.now ? this.shows.found : this.shows.missed;
  }
}
