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
export const orderColour = (t: number) => srgb(ramp("path", t));

function makeTube(positions: Float32Array, colours: Float32Array, width_px: number,
    opacity: number) {
  const geometry = new LineSegmentsGeometry();
  if (positions.length > 0) geometry.setPositions(positions).setColors(colours);
  const tube = new LineSegments2(geometry, new LineMaterial({ linewidth: width_px,
    vertexColors: true, transparent: opacity < 1, opacity }));
  tube.frustumCulled = false;
  return tube;
}

/** The flown path, the profile's part of it thin and grey; show(n) leaves the first n samples. */
export class PathMark {
  readonly object = new three.Group();
  private readonly profile: LineSegments2;
  private readonly planned: LineSegments2;
  private readonly firstView: number; // sample
  private layers = [true, true];

  constructor(flight: Flight) {
    const points = flight.points ?? new Float32Array();
    const count = points.length / 3;
    this.firstView = Math.min(flight.firstViewSample(), count);
    const grey = new three.Color(isDark() ? 0x75808e : 0x8a95a3);
    const piece = (begin: number, end: number, colourOf: (i: number) => three.Color) => {
      const segments = Math.max(0, end - begin - 1);
      const positions = new Float32Array(6 * segments);
      const colours = new Float32Array(6 * segments);
      for (let i = 0; i < segments; ++i) {
        positions.set(points.subarray(3 * (begin + i), 3 * (begin + i) + 6), 6 * i);
        colourOf(i / segments).toArray(colours, 6 * i);
        colourOf(i / segments).toArray(colours, 6 * i + 3);
      }
      return { positions, colours };
    };
    const before = piece(0, this.firstView, () => grey);
    const after = piece(Math.max(0, this.firstView - 1), count, orderColour);
    this.profile = makeTube(before.positions, before.colours, 1.2, 0.7);
    this.planned = makeTube(after.positions, after.colours, 2.4, 1);
    this.object.add(this.profile, this.planned);
  }

  setLayers(showsPlanned: boolean, showsProfile: boolean) {
    this.layers = [showsPlanned, showsProfile];
  }

  show(samples: number) {
    const profile = Math.min(samples, this.firstView) - 1;
    const planned = samples - this.firstView;
    this.profile.geometry.instanceCount = Math.max(0, profile);
    this.profile.visible = this.layers[1] && profile > 0;
    this.planned.geometry.instanceCount = Math.max(0, planned);
    this.planned.visible = this.layers[0] && planned > 0;
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
    const edgesAt = (view: number) =>
      flight.camerasAt(view).flatMap((camera) => pyramidEdges(camera, 0.9));
    this.perView = edgesAt(0).length;
    const positions = new Float32Array(3 * this.perView * flight.count);
    const colours = new Float32Array(positions.length);
    for (let view = 0; view < flight.count; ++view) {
      const { p, q } = flight.viewPose(view);
      const colour = orderColour(view / Math.max(1, flight.count - 1));
      edgesAt(view).forEach((edge, i) => {
        const at = 3 * (view * this.perView + i);
        edge.applyQuaternion(q).add(p).toArray(positions, at);
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
  const faces = new three.MeshBasicMaterial({ color: 0xff8a3c, transparent: true, opacity: 0.07,
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
