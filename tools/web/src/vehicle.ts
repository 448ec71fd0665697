// A quadrotor with its rotors where the scenario's airframe has them.
import * as three from "three";
import { colourOf } from "./colours";
import type { RunData } from "./data";

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
