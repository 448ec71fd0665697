// What stands and flies there: the structure, the surface made of the run, the vehicle.
import * as three from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { colourOf } from "./colours";
import type { MeshData, MoverData, RunData } from "./data";
import { kMarkLayer, kSurfaceLayer } from "./painter";

/** The structure as its mesh has it: solid, or a ghost under what was measured of it. */
export class Structure {
  readonly object = new three.Group();
  private readonly meshes: three.Mesh<three.BufferGeometry, three.MeshLambertMaterial>[];

  constructor({ vertices, colours, parts }: MeshData) {
    const position = new three.BufferAttribute(vertices, 3);
    const colour = colours && new three.BufferAttribute(colours, 3, true);
    this.meshes = parts.map(({ rgb, corners }) => {
      const geometry = new three.BufferGeometry().setAttribute("position", position)
        .setIndex(new three.BufferAttribute(corners, 1));
      if (colour) geometry.setAttribute("color", colour);
      return new three.Mesh(geometry, new three.MeshLambertMaterial({
        color: new three.Color(...rgb), vertexColors: colour !== null, flatShading: true,
        side: three.DoubleSide, forceSinglePass: true })); // a ghost is too faint for its order
    });
    this.object.add(...this.meshes);
  }

  /** Whether it stands in a ray's way before `far`. */
  hides(from: three.Vector3, way: three.Vector3, far: number): boolean {
    const ray = new three.Raycaster(from, way, 0, far);
    ray.layers.enableAll();
    return ray.intersectObject(this.object).length > 0;
  }

  /** Solid, or a ghost that hides nothing. */
  setGhost(isGhost: boolean) {
    for (const mesh of this.meshes) {
      Object.assign(mesh.material, { transparent: isGhost, opacity: isGhost ? 0.13 : 1,
        depthWrite: !isGhost, needsUpdate: true });
      mesh.layers.set(isGhost ? kMarkLayer : kSurfaceLayer);
      mesh.renderOrder = isGhost ? -1 : 0; // under the marks
    }
  }
}

/** Of a body that is `along` metres on its way: how far from where it stood. */
function offsetOn({ way, is_loop }: MoverData, along: number): three.Vector3 {
  const corners = way.map((corner) => new three.Vector3(...corner));
  const edges = corners.slice(1).map((to, i) => to.clone().sub(corners[i]));
  const round = edges.reduce((sum, edge) => sum + edge.length(), 0);
  let left = is_loop && round > 0 ? along % round : along;
  for (const [i, edge] of edges.entries()) {
    if (left < edge.length()) return corners[i].addScaledVector(edge, left / edge.length());
    left -= edge.length();
  }
  return corners[corners.length - 1];
}

/** A body on its way among what stands there. */
export class MovingBody extends Structure {
  constructor(private readonly data: MoverData) { super(data.shape); }

  /** Where it was that many seconds after the take-off. */
  show(time: number) {
    this.object.position.copy(offsetOn(this.data, this.data.speed_m_s * time));
  }
}

/**
 * The surface that `gnbv surface` made of the run; empty until the binary glTF is read, and where
 * it is damaged.
 */
export function readRunSurface(glb: Uint8Array<ArrayBuffer>, loaded: () => void): three.Group {
  const surface = new three.Group();
  surface.rotation.x = Math.PI / 2; // glTF has y up
  const loader = new GLTFLoader().register((parser) => {
    // of an <img>: the page's policy forbids all that fetches, as the loader's own choice does
    Object.assign(parser, { textureLoader: new three.TextureLoader() });
    return { name: "pictures by <img>" };
  });
  loader.parse(glb.slice().buffer, "", ({ scene }) => {
    scene.traverse((part) => {
      const { material } = part as three.Mesh<three.BufferGeometry, three.MeshBasicMaterial>;
      if (!material) return;
      material.side = three.DoubleSide;
      if (!material.map) return;
      material.map.generateMipmaps = false;
      material.map.minFilter = three.LinearFilter;
    });
    surface.add(scene);
    loaded();
  }, console.warn);
  return surface;
}

/** A quadrotor with its rotors where the scenario's airframe has them. */
export function makeVehicle({ rotors, radius_m: r }: RunData): three.Group {
  const group = new three.Group();
  // as the ghost of a structure, so that one shader is compiled for both
  const like = { flatShading: true, side: three.DoubleSide, forceSinglePass: true,
    transparent: true };
  const dark = new three.MeshLambertMaterial({ ...like, color: colourOf("hull") });
  const front = new three.MeshLambertMaterial({ ...like, color: colourOf("front_rotors"),
    emissive: 0x6b2600 });
  const disc = new three.MeshBasicMaterial(
    { color: colourOf("rear_rotors"), transparent: true, opacity: 0.45, depthWrite: false,
      side: three.DoubleSide });
  const add = (geometry: three.BufferGeometry, material: three.Material, x = 0, y = 0, z = 0) => {
    const mesh = new three.Mesh(geometry, material);
    mesh.position.set(x, y, z);
    group.add(mesh);
    return mesh;
  };
  add(new three.BoxGeometry(0.75 * r, 0.42 * r, 0.22 * r), dark);
  add(new three.BoxGeometry(0.16 * r, 0.3 * r, 0.2 * r), front, 0.43 * r);
  for (const [x, y, z] of rotors) {
    const length = Math.hypot(x, y);
    const arm = add(new three.BoxGeometry(length, 0.08 * r, 0.07 * r), x > 0 ? front : dark,
      x / 2, y / 2, z / 2);
    arm.rotation.z = Math.atan2(y, x);
    const ring = add(new three.TorusGeometry(0.33 * r, 0.03 * r, 6, 32), dark, x, y, z + 0.1 * r);
    ring.renderOrder = 1;
    add(new three.CircleGeometry(0.33 * r, 32), disc, x, y, z + 0.1 * r);
  }
  return group;
}
