// The surface that `gnbv surface` made of the run: the binary glTF of tools/surface/glb_file.cpp,
// and of it what that writes: one mesh, unlit, with a texture or with colours. A loader for all of
// glTF would fetch its picture, which the page's policy forbids.
import * as three from "three";
import { kSurfaceLayer } from "./depth_shading";

interface Gltf {
  meshes: { primitives: { attributes: Record<string, number>; indices: number }[] }[];
  accessors: { bufferView: number; componentType: number; count: number; type: string }[];
  bufferViews: { byteOffset: number; byteLength: number }[];
  images?: { bufferView: number }[];
}

const kHeader = 12; // bytes, then chunks: length, type, content
const kChunkHeader = 8;
const kSizes: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

/** Null where the bytes are no such file: the page does without. */
export function readRunSurface(glb: Uint8Array<ArrayBuffer>,
    loaded: () => void): three.Mesh | null {
  try {
    return meshOf(glb, loaded);
  } catch (error) {
    console.warn(error);
    return null;
  }
}

function meshOf(glb: Uint8Array<ArrayBuffer>, loaded: () => void): three.Mesh {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  const jsonBytes = view.getUint32(kHeader, true);
  const jsonBegin = kHeader + kChunkHeader;
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(jsonBegin, jsonBegin + jsonBytes))) as
    Gltf;
  const begin = jsonBegin + jsonBytes + kChunkHeader;
  const partOf = (index: number) => {
    const { byteOffset, byteLength } = json.bufferViews[index];
    return glb.slice(begin + byteOffset, begin + byteOffset + byteLength);
  };
  const attribute = (index: number) => {
    const { bufferView, componentType, type } = json.accessors[index];
    const { buffer } = partOf(bufferView);
    const values = componentType === 5126 ? new Float32Array(buffer)
      : componentType === 5125 ? new Uint32Array(buffer) : new Uint16Array(buffer);
    return new three.BufferAttribute(values, kSizes[type], componentType === 5123);
  };
  const { attributes, indices } = json.meshes[0].primitives[0];
  const geometry = new three.BufferGeometry();
  geometry.setAttribute("position", attribute(attributes.POSITION)).setIndex(attribute(indices));
  if (attributes.TEXCOORD_0 !== undefined) {
    geometry.setAttribute("uv", attribute(attributes.TEXCOORD_0));
  } else {
    geometry.setAttribute("color", attribute(attributes.COLOR_0));
  }
  const material = new three.MeshBasicMaterial({ side: three.DoubleSide,
    vertexColors: attributes.COLOR_0 !== undefined });
  if (json.images) material.map = pictureOf(partOf(json.images[0].bufferView), loaded);
  const mesh = new three.Mesh(geometry, material);
  mesh.rotation.x = Math.PI / 2; // glTF has y up
  mesh.frustumCulled = false;
  mesh.layers.set(kSurfaceLayer);
  return mesh;
}

function pictureOf(png: Uint8Array<ArrayBuffer>, loaded: () => void): three.Texture {
  const texture = new three.Texture();
  texture.flipY = false;
  texture.colorSpace = three.SRGBColorSpace;
  texture.generateMipmaps = false;
  texture.minFilter = three.LinearFilter;
  const image = new Image();
  image.addEventListener("load", () => {
    URL.revokeObjectURL(image.src);
    texture.image = image;
    texture.needsUpdate = true;
    loaded();
  });
  image.src = URL.createObjectURL(new Blob([png], { type: "image/png" }));
  return texture;
}
