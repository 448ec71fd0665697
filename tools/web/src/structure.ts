// The structure as its mesh has it: solid, or a ghost under what was measured of it.
import * as three from "three";
import type { MeshData } from "./data";
import { kMarkLayer, kSurfaceLayer } from "./painter";

export class Structure {
  readonly object = new three.Group();
  private readonly meshes: three.Mesh<three.BufferGeometry, three.MeshLambertMaterial>[];

  constructor({ vertices, parts }: MeshData) {
    const position = new three.BufferAttribute(vertices, 3);
    this.meshes = parts.map(({ rgb, corners }) => new three.Mesh(
      new three.BufferGeometry().setAttribute("position", position)
        .setIndex(new three.BufferAttribute(corners, 1)),
      new three.MeshLambertMaterial({ color: new three.Color(...rgb), flatShading: true,
        side: three.DoubleSide, forceSinglePass: true }))); // a ghost is too faint for its order
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
