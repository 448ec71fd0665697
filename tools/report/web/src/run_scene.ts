// The scene of one run: what is there, and what of it shows at a moment of the replay.
import * as three from "three";
import { hairline } from "./colours";
import { kMarkLayer } from "./depth_shading";
import type { Clock } from "./clock";
import { Bytes, type MeshData } from "./data";
import type { Flight } from "./flight";
import { FrustaMark, PathMark, PlanMark, makeSight } from "./marks";
import { Structure } from "./structure";
import { Model, type Colouring } from "./surfaces";
import { TrueSurface } from "./true_surface";
import { makeVehicle } from "./vehicle";
import { BelievedMarks, type BelievedLayer } from "./believed";
import { CandidateMarks } from "./candidates";
import type { Picked } from "./pick";
import { readRunSurface } from "./run_surface";
import { Splats } from "./splats";

/** Pixels on a side of the gist of a picture, of those of the whole one. */
export const kGistRatio = 0.5;

export interface Layers extends Record<BelievedLayer, boolean> {
  cloud: boolean;
  voxels: boolean;
  structure: boolean;
  path: boolean; // from the first view on
  profile: boolean; // and before
  frusta: boolean;
  plan: boolean; // of a tour: what is still to come
  vehicle: boolean;
  found: boolean; // voxels of the true surface
  missed: boolean;
  candidates: boolean; // of the decision that chose the view
  surface: boolean; // that `gnbv surface` made
}

/** Lines on the ground, every 1, 2, 5, 10 ... m so that there are 8 to 20 each way. */
function gridStep(min: number[], max: number[]): number {
  const extent = Math.max(max[0] - min[0], max[1] - min[1]);
  const decade = 10 ** Math.floor(Math.log10(extent / 8));
  return decade * (extent / 8 >= 5 * decade ? 5 : extent / 8 >= 2 * decade ? 2 : 1);
}

function makeGround(min: number[], max: number[]): three.GridHelper {
  const extent = Math.max(max[0] - min[0], max[1] - min[1]);
  const step = gridStep(min, max);
  const count = 2 * Math.ceil(extent / step / 2 + 1);
  const grid = new three.GridHelper(count * step, count, hairline(), hairline());
  (grid.material as three.Material).transparent = true;
  (grid.material as three.Material).opacity = 0.95;
  (grid.material as three.Material).depthWrite = false;
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
  private readonly body: three.Group;
  private sightMark: three.Group;
  private lookedAs = -1; // view
  readonly structure: Structure | null;
  private readonly path: PathMark;
  readonly frusta: FrustaMark;
  readonly plan: PlanMark | null;
  readonly surface: TrueSurface | null;
  readonly candidates: CandidateMarks | null;
  readonly believed: BelievedMarks | null;
  readonly runSurface: three.Mesh | null;
  onLoad = () => {}; // of the picture on that surface
  private layers: Layers | null = null;
  readonly gridStep_m: number;
  private others: RunScene[] = [];
  private readonly splats = new Splats();

  constructor(readonly flight: Flight, mesh: MeshData | undefined, meshBytes: Bytes) {
    const data = flight.data;
    this.model = new Model(data, flight.bytes);
    this.structure = mesh ? new Structure(mesh, meshBytes) : null;
    this.path = new PathMark(flight);
    this.frusta = new FrustaMark(flight);
    this.plan = data.plan && new PlanMark(flight);
    this.candidates = data.candidates
      && new CandidateMarks(flight, this.model, data.candidates, this.sightMost_m());
    this.believed = data.beliefs && new BelievedMarks(data.beliefs, flight.bytes);
    this.surface = mesh?.surface && data.found ? new TrueSurface(mesh.surface, meshBytes,
      flight.bytes.u16(data.found), flight.count) : null;
    this.runSurface = data.surface
      && readRunSurface(flight.bytes.u8(data.surface), () => this.onLoad());
    this.gridStep_m = gridStep(data.workspace.min, data.workspace.max);
    this.body = makeVehicle(data.vehicle);
    this.sightMark = makeSight(data.cameras, this.sightMost_m());
    this.vehicle.add(this.body, this.sightMark);
    const sun = new three.DirectionalLight(0xffffff, 2.1);
    sun.position.set(-0.5, -0.8, 1.4);
    const sky = new three.HemisphereLight(0xffffff, 0x8d939c, 1.5);
    for (const light of [sun, sky]) light.layers.enable(kMarkLayer);
    this.scene.add(sun, sky);
    const marks: three.Object3D[] = [this.path.object, this.frusta.object, this.vehicle];
    if (this.plan) marks.push(this.plan.object);
    if (this.candidates) marks.push(this.candidates.object);
    if (this.believed) marks.push(this.believed.object);
    if (data.has_ground) marks.unshift(makeGround(data.workspace.min, data.workspace.max));
    const { cloud, voxels } = this.model;
    for (const part of [this.structure?.object, cloud, voxels, this.surface?.object, this.runSurface]) {
      if (part) this.scene.add(part);
    }
    this.scene.add(this.splats.object, ...marks);
    for (const mark of marks) {
      mark.traverse((part) => part.layers.set(kMarkLayer));
    }
  }

  setLayers(layers: Layers) {
    this.layers = layers;
    if (this.runSurface) this.runSurface.visible = layers.surface;
    if (this.model.cloud) this.model.cloud.visible = layers.cloud;
    if (this.model.voxels) this.model.voxels.visible = layers.voxels;
    if (this.structure) {
      this.structure.object.visible = layers.structure;
      this.structure.setGhost(isMeasured(layers));
    }
    this.model.isFaded = layers.missed && !!this.surface;
    this.frusta.object.visible = layers.frusta;
    if (this.plan) this.plan.object.visible = layers.plan;
    this.vehicle.visible = layers.vehicle;
    this.surface?.setLayers(layers.found, layers.missed);
    if (this.candidates) this.candidates.object.visible = layers.candidates;
    this.believed?.setLayers(layers);
  }

  /** Whether a line parts the truth from what the run made of it. */
  isSwiped() { return !!this.runSurface?.visible && !!this.structure; }

  /** Left of that line the structure, right of it the surface, alone; then all as chosen. */
  showSide(side: "truth" | "surface" | "all") {
    const { layers, structure, runSurface, model } = this;
    if (!layers || !structure || !runSurface) return;
    structure.object.visible = side === "truth" || (side === "all" && layers.structure);
    structure.setGhost(side !== "truth" && isMeasured(layers));
    runSurface.visible = side !== "truth" && layers.surface;
    if (model.cloud) model.cloud.visible = side === "all" && layers.cloud;
    if (model.voxels) model.voxels.visible = side === "all" && layers.voxels;
  }

  colour(by: Colouring) {
    this.model.colour(by);
    this.surface?.colourByOrder(by === "iteration");
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
   * whole, or the gist of it; `splats`: its points are drawn here, not by the renderer.
   */
  show(clock: Clock, camera: three.PerspectiveCamera, pxPerTan: number, isWhole: boolean,
      splats: boolean) {
    const n = this.flight.viewsAt(clock);
    this.structure?.show(isWhole);
    this.model.show(n, pxPerTan);
    // where there is no path yet, that of the profile leads to the vehicle
    const { path, profile } = this.layers ?? {};
    this.path.setLayers(!!path, !!(profile || (path && n === 0)));
    this.path.show(this.flight.samplesBy(this.flight.timeAt(clock)), isWhole);
    this.frusta.show(n);
    this.plan?.show(n);
    this.candidates?.show(n);
    this.believed?.show(n);
    this.surface?.show(n, this.others.map(({ flight }) => flight.viewsAt(clock)), pxPerTan);
    if (splats) {
      this.splats.show([...this.model.splats(), ...this.surface?.splats() ?? []], camera, pxPerTan,
        isWhole ? 1 : kGistRatio);
    }
    const pose = this.flight.poseAt(clock);
    if (!pose) return;
    this.vehicle.position.copy(pose.p);
    this.vehicle.quaternion.copy(pose.q);
    if (n > 0) this.lookAs(n - 1);
    this.sightMark.visible = n > 0 && !this.candidates?.object.visible; // it has rays of its own
    // from afar larger than life, or it would be a speck
    const away = camera.position.distanceTo(pose.p);
    this.body.scale.setScalar(Math.max(1, 0.028 * away / this.flight.data.vehicle.radius_m));
  }

  /** Where cameras see farther than this they would fill the picture. */
  private sightMost_m(): number {
    const { min, max } = this.flight.data.workspace;
    return 0.25 * new three.Vector3(...min).distanceTo(new three.Vector3(...max));
  }

  /** How far what the cameras see is drawn, and whether that is as far as they see. */
  sight(): { length_m: number; isWhole: boolean } {
    const range_m = Math.max(...this.flight.data.cameras.map((camera) => camera.range_m));
    const length_m = Math.min(range_m, this.sightMost_m());
    return { length_m, isWhole: length_m === range_m };
  }

  /** What the cameras see at a view, where a gimbal turns them. */
  private lookAs(view: number) {
    if (view === this.lookedAs || !this.flight.data.views.T_body_camera) return;
    this.lookedAs = view;
    this.vehicle.remove(this.sightMark);
    this.sightMark.traverse((part) => (part as three.Mesh).geometry?.dispose());
    this.sightMark = makeSight(this.flight.camerasAt(view), this.sightMost_m());
    this.sightMark.traverse((part) => part.layers.set(kMarkLayer));
    this.vehicle.add(this.sightMark);
  }

  /** Metres over which shading is to look for the slope of what has no normals; 0: it is not to. */
  relief_m(): number { return this.surface?.object.visible ? 2.5 * this.surface.size_m : 0; }

  /** Everything that can show: structure, points, and where the vehicle may fly. */
  bounds(): three.Box3 {
    const { min, max } = this.flight.data.workspace;
    return new three.Box3().setFromArray(this.outline())
      .expandByPoint(new three.Vector3(...min)).expandByPoint(new three.Vector3(...max));
  }

  /**
   * Points (x y z each) that a camera should show: what stands there, where the views are and the
   * profile ends, and what of the layers lies elsewhere.
   */
  outline(): Float32Array {
    const { flight, layers } = this;
    const { x, y, z } = flight.data.views;
    const views = x.flatMap((_, i) => [x[i], y[i], z[i]]);
    const profile = flight.points?.subarray(0, 3 * Math.min(flight.firstViewSample(),
      flight.points.length / 3)) ?? [];
    const parts: ArrayLike<number>[] = [this.shape(), views, this.aroundProfileEnd()];
    if (layers?.profile) parts.push(profile);
    if (layers?.candidates) parts.push(this.candidates?.drawn() ?? []);
    if (layers?.plan) parts.push(this.plan?.drawn() ?? []);
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
    if (!this.model.cloud?.visible) return;
    for (const { at, view } of this.model.shownPoints()) {
      const place = at.clone();
      yield { at, ahead: 0, of: () => ({ at: place, what: `A point that ${words(view)} brought`,
        view: Math.max(view, 0) }) };
    }
  }

  private shape(): Float32Array {
    for (const part of [this.structure?.object.children[0] as three.Mesh | undefined, this.model.cloud]) {
      const position = part?.geometry.getAttribute("position");
      if (position && position.count > 0) return position.array as Float32Array;
    }
    const { min, max } = this.flight.data.workspace;
    return new Float32Array([...min, ...max]);
  }
}
