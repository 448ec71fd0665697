// The structure as its mesh has it: solid, or a ghost under what was measured of it.
import * as three from "three";
import type { Bytes, MeshData } from "./data";
import { kMarkLayer, kSurfaceLayer } from "./depth_shading";

const kGistCells = 90; // along the structure: corners in one of them are one corner of the gist
const kFewFaces = 8000; // need no gist

export class Structure {
  readonly object = new three.Group();
  private readonly parts: { mesh: three.Mesh; whole: three.BufferGeometry;
    gist: three.BufferGeometry }[] = [];

  constructor(mesh: MeshData, bytes: Bytes) {
    const places = bytes.points(mesh.vertices);
    const position = new three.BufferAttribute(places, 3);
    const cell_m = Math.max(...mesh.vertices.size) / kGistCells;
    const faces = mesh.parts.reduce((sum, part) => sum + part.corners[1] / 3, 0);
    const corners = faces > kFewFaces ? sharedCorners(places, cell_m) : null;
    const geometryOf = (index: Uint32Array) => {
      const geometry = new three.BufferGeometry();
      geometry.setAttribute("position", position);
      return geometry.setIndex(new three.BufferAttribute(index, 1));
    };
    for (const part of mesh.parts) {
      const index = bytes.u32(part.corners);
      const whole = geometryOf(index);
      const gist = corners ? geometryOf(withFewerFaces(index, corners)) : whole;
      const solid = new three.MeshLambertMaterial({ color: new three.Color(...part.rgb),
        flatShading: true, side: three.DoubleSide,
        forceSinglePass: true }); // a ghost is too faint for its order to show
      const object = new three.Mesh(whole, solid);
      this.parts.push({ mesh: object, whole, gist });
      this.object.add(object);
    }
  }

  /** Whether it stands in a ray's way before `far`. */
  hides(from: three.Vector3, way: three.Vector3, far: number): boolean {
    const ray = new three.Ray(from, way);
    const [a, b, c, at] = Array.from({ length: 4 }, () => new three.Vector3());
    return this.parts.some(({ whole }) => {
      const places = whole.getAttribute("position").array;
      const index = whole.getIndex()!.array;
      for (let i = 0; i < index.length; i += 3) {
        a.fromArray(places, 3 * index[i]);
        b.fromArray(places, 3 * index[i + 1]);
        c.fromArray(places, 3 * index[i + 2]);
        if (ray.intersectTriangle(a, b, c, false, at) && at.distanceTo(from) < far) return true;
      }
      return false;
    });
  }

  /** All of its faces, or few that look alike from afar. */
  show(isWhole: boolean) {
    for (const { mesh, whole, gist } of this.parts) mesh.geometry = isWhole ? whole : gist;
  }

  /** Solid, or a ghost that hides nothing. */
  setGhost(isGhost: boolean) {
    for (const { mesh } of this.parts) {
      const material = mesh.material as three.MeshLambertMaterial;
      material.transparent = isGhost;
      material.opacity = isGhost ? 0.13 : 1;
      material.depthWrite = !isGhost;
      material.needsUpdate = true;
      mesh.layers.set(isGhost ? kMarkLayer : kSurfaceLayer);
      mesh.renderOrder = isGhost ? -1 : 0; // under the marks
    }
  }
}

/** Of each corner the first one in its cell. */
function sharedCorners(places: Float32Array, cell_m: number): Uint32Array {
  const firsts = new Map<number, number>();
  return Uint32Array.from({ length: places.length / 3 }, (_, corner) => {
    let key = 0;
    for (let axis = 0; axis < 3; ++axis) {
      key = key * 65536 + 32768 + Math.round(places[3 * corner + axis] / cell_m);
    }
    const first = firsts.get(key);
    if (first === undefined) firsts.set(key, corner);
    return first ?? corner;
  });
}

/** The faces whose corners stay apart. */
function withFewerFaces(index: Uint32Array, corners: Uint32Array): Uint32Array {
  const kept: number[] = [];
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [corners[index[i]], corners[index[i + 1]], corners[index[i + 2]]];
    if (a !== b && b !== c && c !== a) kept.push(a, b, c);
  }
  return Uint32Array.from(kept);
}
