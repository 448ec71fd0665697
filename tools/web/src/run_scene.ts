// The scene of one run: what is there, and what of it shows at a moment of the replay.
import * as three from "three";
import { MovingBody, Structure, makeVehicle, readRunSurface } from "./bodies";
import { hairline } from "./colours";
import type { MeshData, PageData, RunData } from "./data";
import { BelievedMarks, CandidateMarks } from "./decisions";
import type { Flight } from "./flight";
import { FrustaMark, PathMark, PlanMark, SightMark } from "./marks";
import { Splats, kMarkLayer, kSun, type Shot } from "./painter";
import type { Thing } from "./pointing";
import { Model, type Colouring } from "./surfaces";
import { TrueSurface } from "./true_surface";

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

const kMeasured = ["cloud", "voxels", "found", "missed", "surface", "unknown", "predicted",
  "frontiers"];

export class RunScene {
  readonly scene = new three.Scene();
  readonly vehicle = new three.Group(); // at the vehicle's pose
  readonly model: Model;
  readonly structure: Structure | null;
  readonly movers: MovingBody[];
  readonly frusta: FrustaMark;
  readonly plan: PlanMark | null;
  readonly surface: TrueSurface | null;
  readonly candidates: CandidateMarks | null;
  readonly believed: BelievedMarks | null;
  others: RunScene[] = []; // around the same structure: what they found is told apart
  onLoad = () => {}; // of the picture on the run's surface
  private readonly runSurface: three.Group | null;
  private readonly body: three.Group;
  private readonly sightMark: SightMark;
  private readonly path: PathMark;
  private layers: Layers = {};
  private readonly splats = new Splats();

  constructor(readonly flight: Flight, { meshes, movers }: PageData) {
    const data = flight.data;
    const mesh: MeshData | undefined = meshes[data.mesh];
    this.model = new Model(data);
    this.structure = mesh ? new Structure(mesh) : null;
    this.movers = movers.filter((mover) => mover.mesh === data.mesh)
      .map((mover) => new MovingBody(mover));
    this.path = new PathMark(flight);
    this.frusta = new FrustaMark(flight);
    this.plan = data.plan && new PlanMark(flight);
    this.candidates = data.candidates
      && new CandidateMarks(flight, this.model, data.candidates);
    this.believed = data.beliefs && new BelievedMarks(data.beliefs);
    this.surface = mesh?.surface && data.found
      ? new TrueSurface(mesh.surface, data.found, flight.count) : null;
    this.runSurface = data.surface && readRunSurface(data.surface, () => this.onLoad());
    this.body = makeVehicle(data);
    this.sightMark = new SightMark(flight);
    this.vehicle.add(this.body, this.sightMark.object);
    const sun = new three.DirectionalLight(0xffffff, 2.1);
    sun.position.copy(kSun);
    const sky = new three.HemisphereLight(0xffffff, 0x8d939c, 1.5);
    for (const light of [sun, sky]) light.layers.enable(kMarkLayer);
    const marks = [this.path.object, this.frusta.object, this.vehicle, this.plan?.object,
      this.candidates?.object, this.believed?.object,
      data.has_ground ? makeGround(data) : null].filter((mark) => !!mark);
    for (const mark of marks) mark.traverse((part) => part.layers.set(kMarkLayer));
    this.scene.add(sun, sky, ...this.movers.map(({ object }) => object),
      ...[this.structure?.object, this.model.voxels, this.runSurface,
      this.splats.object, ...marks].filter((part) => !!part));
    this.scene.traverse((part) => { part.frustumCulled = false; });
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
    const { layers, structure, movers, runSurface, model } = this;
    for (const body of structure ? [structure, ...movers] : []) {
      body.object.visible = side === "truth" || (side === "all" && layers.structure);
      body.setGhost(side !== "truth" && kMeasured.some((layer) => layers[layer]));
    }
    if (runSurface) runSurface.visible = side !== "truth" && layers.surface;
    model.showsPoints = side === "all" && layers.cloud;
    model.voxels.visible = side === "all" && layers.voxels;
  }

  colour(by: Colouring) {
    this.model.colour(by);
    if (this.surface) this.surface.isByOrder = by === "iteration";
  }

  compareWith(others: RunScene[]) {
    this.others = others.filter(({ surface, flight }) => this.surface && surface
      && flight.data.mesh === this.flight.data.mesh);
  }

  /** What was decided and is counted, as things are now. */
  decide() {
    const { n } = this.flight;
    this.candidates?.show(n);
    this.believed?.show(this.flight.planOf(n));
  }

  /** As it is now, for a picture. */
  show(shot: Shot) {
    const { flight, model, surface, layers: { path, profile } } = this;
    const { n } = flight;
    model.show(n);
    for (const mover of this.movers) mover.show(flight.time());
    // where there is no path yet, that of the profile leads to the vehicle
    this.path.show(flight.samplesBy(flight.time()), profile || (path && n === 0), path);
    this.frusta.show(n);
    this.plan?.show(n);
    this.decide();
    surface?.show(n, this.others.map((other) =>
      ({ found: other.surface!.found, views: other.flight.n })));
    this.splats.show([...model.splats(), ...surface?.splats() ?? []], shot);
    const pose = flight.pose();
    if (!pose) return;
    this.vehicle.position.copy(pose.p);
    this.vehicle.quaternion.copy(pose.q);
    // candidates have rays of their own
    this.sightMark.object.visible = n > 0 && !this.candidates?.object.visible;
    this.sightMark.show(n);
    // from afar larger than life, or it would be a speck
    const away = shot.camera.position.distanceTo(pose.p);
    this.body.scale.setScalar(Math.max(1, 0.028 * away / flight.data.radius_m));
  }

  /** Metres over which shading is to look for the slope of what has no normals; 0: it is not to. */
  relief_m(): number { return this.surface?.isVisible() ? 2.5 * this.surface.size_m : 0; }

  /**
   * Places that a camera should show: what stands there, where the views are and the profile ends,
   * and what of the layers lies elsewhere.
   */
  outline(): three.BufferAttribute {
    const { flight, layers } = this;
    const reach_m = 0.03 * flight.size_m; // of the vehicle, enlarged as it is from afar
    const around = Array.from({ length: 8 }, (_, corner) => flight.profileEnd().map((x, axis) =>
      x + (corner >> axis & 1 ? reach_m : -reach_m)));
    const parts: ArrayLike<number>[] = [this.shape(), ...around,
      flight.data.views.pose.filter((_, i) => i % 4 < 3)];
    if (layers.profile) parts.push(flight.points?.subarray(0, 3 * flight.profileSamples()) ?? []);
    const shown = [layers.candidates ? this.candidates?.now.map(({ at }) => at) : null,
      layers.plan ? this.plan?.places : null];
    for (const places of shown) for (const place of places ?? []) parts.push(place.toArray());
    for (const part of this.believed?.object.visible ? this.believed.object.children : []) {
      parts.push((part as three.Mesh).geometry.getAttribute("position").array);
    }
    return new three.Float32BufferAttribute(parts.flatMap((part) => Array.from(part)), 3);
  }

  private shape(): ArrayLike<number> {
    const first = this.structure?.object.children[0] as three.Mesh | undefined;
    const places = first?.geometry.getAttribute("position").array ?? this.model.points;
    const { min, max } = this.flight.workspace;
    return places.length > 0 ? places : [...min.toArray(), ...max.toArray()];
  }

  /** What a pointer can name, as it is shown. */
  *things(): Generator<Thing> {
    const { surface, flight } = this;
    const words = (view: number) => (view < 0 ? "the profile" : `view ${view + 1}`);
    for (let view = 0; view < flight.count && this.frusta.object.visible; ++view) {
      yield { at: flight.viewPose(view).p, ahead: 0.01, view, isView: true,
        what: () => `View ${view + 1}` };
    }
    for (const [i, first] of surface?.found.entries() ?? []) {
      if (!surface!.isShown(i)) continue;
      const isFound = first <= flight.count;
      yield { at: surface!.centre(i), ahead: 1e-4, view: isFound ? Math.max(first - 1, 0) : null,
        what: () => `A voxel of the true surface${isFound
          ? `, found first by ${words(first - 1)}` : " that no view found"}` };
    }
    for (const { at, view } of this.model.shownPoints()) {
      yield { at, ahead: 0, view: Math.max(view, 0),
        what: () => `A point that ${words(view)} brought` };
    }
  }
}
