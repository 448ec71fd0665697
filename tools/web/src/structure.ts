// The structure as its mesh has it: solid, or a ghost under what was measured of it.
import * as three from "three";
import type { MeshData } from "./data";
import { kMarkLayer, kSurfaceLayer } from "./depth_shading";

export class Structure {
  readonly object = new three.Group();
  readonly faces: number;

  constructor({ vertices, parts }: MeshData) {
    const position = new three.BufferAttribute(vertices, 3);
    this.faces = parts.reduce((sum, { corners }) => sum + corners.length / 3, 0);
    for (const { rgb, corners } of parts) {
      const geometry = new three.BufferGeometry();
      geometry.setAttribute("position", position);
      geometry.setIndex(new three.BufferAttribute(corners, 1));
      this.object.add(new three.Mesh(geometry, new three.MeshLambertMaterial({
        color: new three.Color(...rgb), flatShading: true, side: three.DoubleSide,
        forceSinglePass: true }))); // a ghost is too faint for its order to show
    }
  }

  /** Whether it stands in a ray's way before `far`. */
  hides(from: three.Vector3, way: three.Vector3, far: number): boolean {
    const ray = new three.Ray(from, way);
    const [a, b, c, at] = Array.from({ length: 4 }, () => new three.Vector3());
    return this.meshes().some(({ geometry }) => {
      const places = geometry.getAttribute("position").array;
      const index = geometry.getIndex()!.array;
      for (let i = 0; i < index.length; i += 3) {
        a.fromArray(places, 3 * index[i]);
        b.fromArray(places, 3 * index[i + 1]);
        c.fromArray(places, 3 * index[i + 2]);
        if (ray.intersectTriangle(a, b, c, false, at) && at.distanceTo(from) < far) return true;
      }
      return false;
    });
  }

  /** Solid, or a ghost that hides nothing. */
  setGhost(isGhost: boolean) {
    for (const mesh of this.meshes()) {
      const material = mesh.material as three.MeshLambertMaterial;
      material.transparent = isGhost;
      material.opacity = isGhost ? 0.13 : 1;
      material.depthWrite = !isGhost;
      material.needsUpdate = true;
      mesh.layers.set(isGhost ? kMarkLayer : kSurfaceLayer);
      mesh.renderOrder = isGhost ? -1 : 0; // under the marks
    }
  }

  private meshes() { return this.object.children as three.Mesh[]; }
}
