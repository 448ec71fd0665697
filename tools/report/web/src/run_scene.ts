// The scene of one run: what is there, and what of it shows at a moment of the replay.
import * as three from "three";
import { hairline } from "./colours";
import { kMarkLayer } from "./depth_shading";
import type { Clock } from "./clock";
import { Bytes, type MeshData } from "./data";
import type { Flight } from "./flight";
import { FrustaMark, PathMark, PlanMark, makeSight } from "./marks";
import { Model, makeStructure, setGhost, type Colouring } from "./surfaces";
import { makeVehicle } from "./vehicle";

export interface Layers {
  cloud: boolean;
  voxels: boolean;
  structure: boolean;
  path: boolean; // from the first view on
  profile: boolean; // and before
  frusta: boolean;
  plan: boolean; // of a tour: what is still to come
  vehicle: boolean;
}

/** Lines on the ground, every 1, 2, 5, 10 ... m so that there are 8 to 20 each way. */
function makeGround(min: number[], max: number[]): three.GridHelper {
  const extent = Math.max(max[0] - min[0], max[1] - min[1]);
  const decade = 10 ** Math.floor(Math.log10(extent / 8));
  const step = decade * (extent / 8 >= 5 * decade ? 5 : extent / 8 >= 2 * decade ? 2 : 1);
  const count = 2 * Math.ceil(extent / step / 2 + 1);
  const grid = new three.GridHelper(count * step, count, hairline(), hairline());
  (grid.material as three.Material).transparent = true;
  (grid.material as three.Material).opacity = 0.95;
  (grid.material as three.Material).depthWrite = false;
  grid.rotation.x = Math.PI / 2; // three's grids lie in x, z
  grid.position.set((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, 0);
  return grid;
}

export class RunScene {
  readonly scene = new three.Scene();
  readonly vehicle = new three.Group(); // at the vehicle's pose
  readonly model: Model;
  private readonly body: three.Group;
  private sight: three.Group;
  private lookedAs = -1; // view
  private readonly structure: three.Group | null;
  private readonly path: PathMark;
  private readonly frusta: FrustaMark;
  readonly plan: PlanMark | null;

  constructor(readonly flight: Flight, mesh: MeshData | undefined, meshBytes: Bytes) {
    const data = flight.data;
    this.model = new Model(data, flight.bytes);
    this.structure = mesh ? makeStructure(mesh, meshBytes) : null;
    this.path = new PathMark(flight);
    this.frusta = new FrustaMark(flight);
    this.plan = data.plan && new PlanMark(flight);
    this.body = makeVehicle(data.vehicle);
    this.sight = makeSight(data.cameras);
    this.vehicle.add(this.body, this.sight);
    const sun = new three.DirectionalLight(0xffffff, 2.1);
    sun.position.set(-0.5, -0.8, 1.4);
    const sky = new three.HemisphereLight(0xffffff, 0x8d939c, 1.5);
    for (const light of [sun, sky]) light.layers.enable(kMarkLayer);
    this.scene.add(sun, sky);
    const marks: three.Object3D[] = [this.path.object, this.frusta.object, this.vehicle];
    if (this.plan) marks.push(this.plan.object);
    if (data.has_ground) marks.unshift(makeGround(data.workspace.min, data.workspace.max));
    for (const part of [this.structure, this.model.cloud, this.model.voxels]) {
      if (part) this.scene.add(part);
    }
    this.scene.add(...marks);
    for (const mark of marks) {
      mark.traverse((part) => part.layers.set(kMarkLayer));
    }
  }

  setLayers(layers: Layers) {
    if (this.model.cloud) this.model.cloud.visible = layers.cloud;
    if (this.model.voxels) this.model.voxels.visible = layers.voxels;
    if (this.structure) {
      this.structure.visible = layers.structure;
      setGhost(this.structure, layers.cloud || layers.voxels);
    }
    this.path.setLayers(layers.path, layers.profile);
    this.frusta.object.visible = layers.frusta;
    if (this.plan) this.plan.object.visible = layers.plan;
    this.vehicle.visible = layers.vehicle;
  }

  colour(by: Colouring) { this.model.colour(by); }

  /** As it is at the clock's time, for a camera that draws `pxPerTan` pixels a unit of tangent. */
  show(clock: Clock, camera: three.PerspectiveCamera, pxPerTan: number) {
    const n = this.flight.viewsAt(clock);
    this.model.show(n, pxPerTan);
    this.path.show(this.flight.samplesBy(this.flight.timeAt(clock)));
    this.frusta.show(n);
    this.plan?.show(n);
    const pose = this.flight.poseAt(clock);
    if (!pose) return;
    this.vehicle.position.copy(pose.p);
    this.vehicle.quaternion.copy(pose.q);
    if (n > 0) this.lookAs(n - 1);
    this.sight.visible = n > 0;
    // from afar larger than life, or it would be a speck
    const away = camera.position.distanceTo(pose.p);
    this.body.scale.setScalar(Math.max(1, 0.028 * away / this.flight.data.vehicle.radius_m));
  }

  /** What the cameras see at a view, where a gimbal turns them. */
  private lookAs(view: number) {
    if (view === this.lookedAs || !this.flight.data.views.T_body_camera) return;
    this.lookedAs = view;
    this.vehicle.remove(this.sight);
    this.sight.traverse((part) => (part as three.Mesh).geometry?.dispose());
    this.sight = makeSight(this.flight.camerasAt(view));
    this.sight.traverse((part) => part.layers.set(kMarkLayer));
    this.vehicle.add(this.sight);
  }

  /** Everything that can show: structure, points, and where the vehicle may fly. */
  bounds(): three.Box3 {
    const { min, max } = this.flight.data.workspace;
    return new three.Box3().setFromArray(this.outline())
      .expandByPoint(new three.Vector3(...min)).expandByPoint(new three.Vector3(...max));
  }

  /** Points (x y z each) that a camera should show. */
  outline(): Float32Array {
    for (const part of [this.structure?.children[0] as three.Mesh | undefined, this.model.cloud]) {
      const position = part?.geometry.getAttribute("position");
      if (position && position.count > 0) return position.array as Float32Array;
    }
    const { min, max } = this.flight.data.workspace;
    return new Float32Array([...min, ...max]);
  }
}
