// The voxels of the true surface: found by a run so far, missed, or found by another run alone.
import { Vector3 } from "three";
import { colourOf, rampHex } from "./colours";
import type { SurfaceData } from "./data";
import type { SplatSource } from "./splats";

export const kNeverFound = 0xffff;
const kNearer = 2; // voxels that missed ones lie before where they are, so that no point hides them

/** Found by a run of the same structure so far, after `views` views. */
export interface FoundSoFar { found: Uint16Array; views: number }

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
