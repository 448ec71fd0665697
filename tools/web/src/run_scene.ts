// The scene of one run: what is there, and what of it shows at a moment of the replay.
import * as three from "three";
import { BelievedMarks } from "./believed";
import { CandidateMarks } from "./candidates";
import type { Clock } from "./clock";
import { hairline } from "./colours";
import type { MeshData, RunData } from "./data";
import { kMarkLayer } from "./depth_shading";
import { rangeOf, type Flight } from "./flight";
import { FrustaMark, PathMark, PlanMark, SightMark } from "./marks";
import type { Picked } from "./pick";
import { readRunSurface } from "./run_surface";
import { Splats } from "./splats";
import { Structure } from "./structure";
import { Model, type Colouring } from "./surfaces";
import { TrueSurface } from "./true_surface";
import { makeVehicle } from "./vehicle";

/** Pixels on a side of the gist of a picture, of those of the whole one. */
export const kGistRatio = 0.5;

/** Which of the scene's layers are shown, by their names (tools/scene/looks.cpp). */
export type Layers = Record<string, boolean>;

/** Of a picture that a line parts: the true structure, the surface made of the run; or all. */
export type Side = "truth" | "surface" | "all";

function makeGround({ workspace_min: min, workspace_max: max, grid_m }: RunData): three.GridHelper {
  const extent = Math.max(max[0] - min[0], max[1] - min[1]);
  const count = 2 * Math.ceil(extent / grid_m / 2 + 1);
  const grid = new three.GridHelper(count * grid_m, count, hairline(), hairline());
  Object.assign(grid.material, { transparent: true, opacity: 0.95, depthWrite: false });
  grid.rotation.x = Math.PI / 2; // three's grids lie in x, z
  grid.position.set((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, 0);
  return grid;
}

const isMeasured = (layers: Layers) =>
  layers.cloud || layers.voxels || layers.found || layers.missed || layers.surface
  || layers.unknown || layers.predicted || layers.frontiers;

export class RunScene {
  readonly scene = new three.Scene();
  readonly vehicle = new three.Group(); // at the vehicle's pose
  readonly model: Model;
  readonly structure: Structure | null;
  readonly frusta: FrustaMark;
  readonly plan: PlanMark | null;
  readonly surface: TrueSurface | null;
  readonly candidates: CandidateMarks | null;
  readonly believed: BelievedMarks | null;
  readonly runSurface: three.Group | null;
  onLoad = () => {}; // of the picture on that surface
  private readonly body: three.Group;
  private readonly sightMark: SightMark;
  private readonly path: PathMark;
  private layers: Layers = {};
  private others: RunScene[] = [];
  private readonly splats = new Splats();

  constructor(readonly flight: Flight, mesh: MeshData | undefined) {
    const data = flight.data;
    this.model = new Model(data);
    this.structure = mesh ? new Structure(mesh) : null;
    this.path = new PathMark(flight);
    this.frusta = new FrustaMark(flight);
    this.plan = data.plan && new PlanMark(flight);
    this.candidates = data.candidates
      && new CandidateMarks(flight, this.model, data.candidates, this.sightMost_m());
    this.believed = data.beliefs && new BelievedMarks(data.beliefs);
    this.surface = mesh?.surface && data.found
      ? new TrueSurface(mesh.surface, data.found, flight.count) : null;
    this.runSurface = data.surface && readRunSurface(data.surface, () => this.onLoad());
    this.body = makeVehicle(data);
    this.sightMark = new SightMark(flight, this.sightMost_m());
    this.vehicle.add(this.body, this.sightMark.object);
    const sun = new three.DirectionalLight(0xffffff, 2.1);
    sun.position.set(-0.5, -0.8, 1.4);
    const sky = new three.HemisphereLight(0xffffff, 0x8d939c, 1.5);
    for (const light of [sun, sky]) light.layers.enable(kMarkLayer);
    this.scene.add(sun, sky);
    const marks = [this.path.object, this.frusta.object, this.vehicle, this.plan?.object,
      this.candidates?.object, this.believed?.object,
      data.has_ground ? makeGround(data) : null];
    for (const part of [this.structure?.object, this.model.voxels, this.runSurface,
      this.splats.object, ...marks]) {
      if (part) this.scene.add(part);
    }
    for (const mark of marks) mark?.traverse((part) => part.layers.set(kMarkLayer));
  }

  /** Which of the layers there is anything for. */
  has(layer: string): boolean {
    const { cloud, voxels, plan, candidates } = this.flight.data;
    const known: Record<string, unknown> = { cloud, voxels, structure: this.structure, plan,
      missed: this.surface, found: this.surface, candidates, surface: this.runSurface,
      unknown: this.believed?.has(layer), predicted: this.believed?.has(layer),
      frontiers: this.believed?.has(layer) };
    return !(layer in known) || !!known[layer];
  }

  setLayers(layers: Layers) {
    this.layers = layers;
    this.showSide("all");
    this.model.isFaded = layers.missed && !!this.surface;
    this.frusta.object.visible = layers.frusta;
    if (this.plan) this.plan.object.visible = layers.plan;
    this.vehicle.visible = layers.vehicle;
    this.surface?.setLayers(layers.found, layers.missed);
    if (this.candidates) this.candidates.object.visible = layers.candidates;
    this.believed?.setLayers(layers);
  }

  /** Whether a line parts the truth from what the run made of it. */
  isSwiped() { return this.layers.surface && !!this.runSurface && !!this.structure; }

  /** Left of that line the structure, right of it the surface, alone; else all as chosen. */
  showSide(side: Side) {
    const { layers, structure, runSurface, model } = this;
    if (structure) {
      structure.object.visible = side === "truth" || (side === "all" && layers.structure);
      structure.setGhost(side !== "truth" && isMeasured(layers));
    }
    if (runSurface) runSurface.visible = side !== "truth" && layers.surface;
    model.showsPoints = side === "all" && layers.cloud;
    if (model.voxels) model.voxels.visible = side === "all" && layers.voxels;
  }

  colour(by: Colouring) {
    this.model.colour(by);
    if (this.surface) this.surface.isByOrder = by === "iteration";
  }

  /** What other runs around the same structure found and this one did not is told apart. */
  compareWith(others: RunScene[]) {
    this.others = others.filter(({ surface, flight }) => surface
      && flight.data.mesh === this.flight.data.mesh);
    this.surface?.compareWith(this.others.map(({ surface }) => surface!));
  }

  /** How many others it is compared with. */
  compared() { return this.surface ? this.others.length : 0; }

  /**
   * As it is at the clock's time, for a camera that draws `pxPerTan` pixels a unit of tangent;
   * whole, or the gist of it.
   */
  show(clock: Clock, camera: three.PerspectiveCamera, pxPerTan: number, isWhole: boolean) {
    const n = this.flight.viewsAt(clock);
    this.model.show(n);
    // where there is no path yet, that of the profile leads to the vehicle
    const { path, profile } = this.layers;
    this.path.show(this.flight.samplesBy(this.flight.timeAt(clock)), profile || (path && n === 0),
      path);
    this.frusta.show(n);
    this.plan?.show(n);
    this.candidates?.show(n);
    this.believed?.show(n);
    this.surface?.show(n, this.others.map(({ flight }) => flight.viewsAt(clock)));
    this.splats.show([...this.model.splats(), ...this.surface?.splats() ?? []], camera, pxPerTan,
      isWhole ? 1 : kGistRatio);
    const pose = this.flight.poseAt(clock);
    if (!pose) return;
    this.vehicle.position.copy(pose.p);
    this.vehicle.quaternion.copy(pose.q);
    // candidates have rays of their own
    this.sightMark.object.visible = n > 0 && !this.candidates?.object.visible;
    this.sightMark.show(n);
    // from afar larger than life, or it would be a speck
    const away = camera.position.distanceTo(pose.p);
    this.body.scale.setScalar(Math.max(1, 0.028 * away / this.flight.data.radius_m));
  }

  /** Where cameras see farther than this they would fill the picture. */
  private sightMost_m(): number { return 0.25 * this.flight.workspace().size_m; }

  /** How far what the cameras see is drawn, and whether that is as far as they see. */
  sight(): { length_m: number; isWhole: boolean } {
    const range_m = rangeOf(this.flight.data.cameras);
    const length_m = Math.min(range_m, this.sightMost_m());
    return { length_m, isWhole: length_m === range_m };
  }

  /** Metres over which shading is to look for the slope of what has no normals; 0: it is not to. */
  relief_m(): number { return this.surface?.isVisible() ? 2.5 * this.surface.size_m : 0; }

  /** Everything that can show: structure, points, and where the vehicle may fly. */
  bounds(): three.Box3 {
    const { workspace_min, workspace_max } = this.flight.data;
    return new three.Box3().setFromArray(this.outline())
      .expandByPoint(new three.Vector3(...workspace_min))
      .expandByPoint(new three.Vector3(...workspace_max));
  }

  /**
   * Points (x y z each) that a camera should show: what stands there, where the views are and the
   * profile ends, and what of the layers lies elsewhere.
   */
  outline(): Float32Array {
    const { flight, layers } = this;
    const views = flight.data.views.pose.filter((_, i) => i % 4 < 3);
    const profile = flight.points?.subarray(0, 3 * Math.min(flight.firstViewSample(),
      flight.points.length / 3)) ?? [];
    const parts: ArrayLike<number>[] = [this.shape(), views, this.aroundProfileEnd()];
    if (layers.profile) parts.push(profile);
    if (layers.candidates) parts.push(this.candidates?.drawn() ?? []);
    if (layers.plan) parts.push(this.plan?.drawn() ?? []);
    for (const part of this.believed?.object.visible ? this.believed.object.children : []) {
      parts.push((part as three.Mesh).geometry.getAttribute("position").array);
    }
    return Float32Array.from(parts.flatMap((part) => Array.from(part)));
  }

  /** Corners around the vehicle, enlarged as it is from afar, before the first view. */
  private aroundProfileEnd(): number[] {
    const end = this.flight.profileEnd();
    const reach_m = 0.12 * this.sightMost_m();
    return end.length === 0 ? [] : Array.from({ length: 8 }, (_, corner) =>
      end.map((x, axis) => x + (corner >> axis & 1 ? reach_m : -reach_m))).flat();
  }

  /** What a pointer can name, as it is shown; `ahead` of what lies in front of it by that depth. */
  *things(): Generator<{ at: three.Vector3; ahead: number; of: () => Picked }> {
    const { surface, flight } = this;
    const words = (n: number) => (n < 0 ? "the profile" : `view ${n + 1}`);
    for (let view = 0; view < flight.count && this.frusta.object.visible; ++view) {
      const at = flight.viewPose(view).p;
      yield { at, ahead: 0.01, of: () => ({ at: at.clone(), what: `View ${view + 1}`, view,
        isView: true }) };
    }
    for (let i = 0; surface && i < surface.found.length; ++i) {
      if (!surface.isShown(i)) continue;
      const at = surface.centre(i);
      const first = surface.found[i];
      const what = first > flight.count ? "A voxel of the true surface that no view found"
        : `A voxel of the true surface, found first by ${words(first - 1)}`;
      yield { at, ahead: 1e-4, of: () => ({ at, what, view: first > flight.count ? null
        : Math.max(first - 1, 0) }) };
    }
    for (const { at, view } of this.model.shownPoints()) {
      const place = at.clone();
      yield { at, ahead: 0, of: () => ({ at: place, what: `A point that ${words(view)} brought`,
        view: Math.max(view, 0) }) };
    }
  }

  private shape(): ArrayLike<number> {
    const first = this.structure?.object.children[0] as three.Mesh | undefined;
    const places = first?.geometry.getAttribute("position").array ?? this.model.points;
    const { workspace_min, workspace_max } = this.flight.data;
    return places.length > 0 ? places : [...workspace_min, ...workspace_max];
  }
}
