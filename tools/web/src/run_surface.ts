// The surface that `gnbv surface` made of the run.
import * as three from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Empty until the binary glTF is read, and where it is damaged. */
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
