// Lines and dots of the mission: flown path, views, camera pyramids.
import * as three from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { isDark, ramp } from "./colours";
import type { CameraData } from "./data";
import type { Flight } from "./flight";

const srgb = (c: [number, number, number]) =>
  new three.Color().setRGB(c[0] / 255, c[1] / 255, c[2] / 255, three.SRGBColorSpace);

/** The colour of the view that is `t` of the way from the first to the last. */
export const orderColour = (t: number) => srgb(ramp("order", isDark() ? 0.12 + 0.88 * t : 0.85 * t));

/** The flown path; show(n) leaves the first n samples of it. */
export class PathMark {
  readonly object: LineSegments2;

  constructor(flight: Flight) {
    const points = flight.points ?? new Float32Array();
    const count = points.length / 3;
    const firstView = flight.firstViewSample();
    const profile = new three.Color(isDark() ? 0x75808e : 0x8a95a3);
    const positions = new Float32Array(Math.max(0, count - 1) * 6);
    const colours = new Float32Array(positions.length);
    for (let i = 0; i + 1 < count; ++i) {
      positions.set(points.subarray(3 * i, 3 * i + 6), 6 * i);
      const colour = i < firstView ? profile : orderColour((i - firstView) / (count - firstView));
      colour.toArray(colours, 6 * i);
      colour.toArray(colours, 6 * i + 3);
    }
    const geometry = new LineSegmentsGeometry();
    if (positions.length > 0) geometry.setPositions(positions).setColors(colours);
    this.object = new LineSegments2(geometry,
      new LineMaterial({ linewidth: 2.2, vertexColors: true }));
    this.object.frustumCulled = false;
  }

  show(samples: number) {
    this.object.geometry.instanceCount = Math.max(0, samples - 1);
    this.object.visible = samples > 1;
  }
}

/** Corners of a camera's picture, `depth` metres in front of it, in the body. */
function pictureCorners(camera: CameraData, depth: number): three.Vector3[] {
  const T = new three.Matrix4().fromArray(camera.T_body_camera);
  const [x, y] = [depth * Math.tan(camera.fov_x / 2), depth * Math.tan(camera.fov_y / 2)];
  return [[-x, -y], [x, -y], [x, y], [-x, y]].map(([u, v]) =>
    new three.Vector3(u, v, depth).applyMatrix4(T));
}

function pyramidEdges(camera: CameraData, depth: number): three.Vector3[] {
  const corners = pictureCorners(camera, depth);
  const apex = new three.Vector3().setFromMatrixPosition(
    new three.Matrix4().fromArray(camera.T_body_camera));
  return corners.flatMap((corner, i) => [apex, corner, corner, corners[(i + 1) % 4]]);
}

/** Small pyramids of every view; show(n) leaves the first n. */
export class FrustaMark {
  readonly object: three.LineSegments;
  private readonly perView: number;

  constructor(flight: Flight) {
    const edges = flight.data.cameras.flatMap((camera) => pyramidEdges(camera, 0.9));
    this.perView = edges.length;
    const positions = new Float32Array(3 * edges.length * flight.count);
    const colours = new Float32Array(positions.length);
    for (let view = 0; view < flight.count; ++view) {
      const { p, q } = flight.viewPose(view);
      const colour = orderColour(view / Math.max(1, flight.count - 1));
      edges.forEach((edge, i) => {
        const at = 3 * (view * edges.length + i);
        edge.clone().applyQuaternion(q).add(p).toArray(positions, at);
        colour.toArray(colours, at);
      });
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(positions, 3));
    geometry.setAttribute("color", new three.BufferAttribute(colours, 3));
    this.object = new three.LineSegments(geometry,
      new three.LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.8 }));
    this.object.frustumCulled = false;
  }

  show(views: number) { this.object.geometry.setDrawRange(0, views * this.perView); }
}

/** What the cameras of the vehicle see now, out to their range; to be put on the vehicle's pose. */
export function makeSight(cameras: CameraData[]): three.Group {
  const group = new three.Group();
  const faces = new three.MeshBasicMaterial({ color: 0xff8a3c, transparent: true, opacity: 0.1,
    depthWrite: false, side: three.DoubleSide });
  const lines = new three.LineBasicMaterial({ color: 0xff8a3c, transparent: true, opacity: 0.75 });
  for (const camera of cameras) {
    const edges = pyramidEdges(camera, camera.range_m);
    group.add(new three.LineSegments(new three.BufferGeometry().setFromPoints(edges), lines));
    const corners = pictureCorners(camera, camera.range_m);
    const sides = corners.flatMap((corner, i) => [edges[0], corner, corners[(i + 1) % 4]]);
    group.add(new three.Mesh(new three.BufferGeometry().setFromPoints(sides), faces));
  }
  return group;
}
