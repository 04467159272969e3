// Draws assets for browser.test.ts: window.draw(...) returns linear pixels.
import { OpenPrtPlugin, parseLighting, relightableOf } from 'openprt-three';
import * as three from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const kSize = 96;
const renderer = new three.WebGLRenderer();
renderer.outputColorSpace = three.LinearSRGBColorSpace;
const target = new three.WebGLRenderTarget(kSize, kSize, { type: three.FloatType });

function load(url, mode) {
    const loader = new GLTFLoader();
    loader.setMeshoptDecoder(MeshoptDecoder);
    loader.register((parser) => new OpenPrtPlugin(parser, { mode }));
    return loader.loadAsync(url);
}

/** Sees all of a scene, from the side that most normals face. */
function cameraFor(scene) {
    const box = new three.Box3().setFromObject(scene);
    const center = box.getCenter(new three.Vector3());
    const radius = box.getSize(new three.Vector3()).length() / 2;
    const facing = new three.Vector3();
    scene.traverse(({ geometry }) => {
        const normals = geometry?.attributes.normal;
        for (let i = 0; i < (normals?.count ?? 0); ++i) facing.add(new three.Vector3().fromBufferAttribute(normals, i));
    });
    const camera = new three.OrthographicCamera(-radius, radius, radius, -radius, 0, 4 * radius);
    camera.position.copy(center).addScaledVector(facing.normalize(), 2 * radius);
    camera.lookAt(center);
    return camera;
}

function pixelsOf(scene, camera) {
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const pixels = new Float32Array(4 * kSize * kSize);
    renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
    return [...pixels];
}

/** Pixels of each kind of transport under a light. */
window.draw = async (url, mode, lighting) => {
    const gltf = await load(url, mode);
    const relightable = relightableOf(gltf);
    relightable.setLighting(parseLighting(lighting));
    const camera = cameraFor(gltf.scene);
    const pictures = {};
    for (const transport of relightable.transports) {
        relightable.setTransport(transport);
        pictures[transport] = pixelsOf(gltf.scene, camera);
    }
    relightable.dispose();
    return pictures;
};

window.refusalOf = (bytes) =>
    new Promise((resolve) => {
        const loader = new GLTFLoader();
        loader.register((parser) => new OpenPrtPlugin(parser));
        loader.parse(new Uint8Array(bytes).buffer, '', () => resolve('nothing'), (error) => resolve(`${error.name}: ${error.message}`));
    });

window.isReady = true;
