// Draws assets for browser.test.ts: window.draw(...) returns linear pixels.
import { OpenPrtPlugin, Relightable, makeLobeTable, parseLighting, receiveLight, reflect, relightableOf } from 'openprt-three';
import * as three from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const kSize = 96;
const renderer = new three.WebGLRenderer();
renderer.outputColorSpace = three.LinearSRGBColorSpace;
const target = new three.WebGLRenderTarget(kSize, kSize, { type: three.FloatType });

function load(url, options) {
    const loader = new GLTFLoader();
    loader.setMeshoptDecoder(MeshoptDecoder);
    loader.register((parser) => new OpenPrtPlugin(parser, options));
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
window.draw = async (url, options, lighting) => {
    const gltf = await load(url, options);
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

/** Pixels of a glossy layer by the shader, and with radiance that reflect() gave at the vertices; materials are as given. */
window.drawGloss = async (url, transport, lighting, surface) => {
    const gltf = await load(url, {});
    const camera = cameraFor(gltf.scene);
    const relightable = relightableOf(gltf);
    relightable.dispose();
    const meshes = [];
    gltf.scene.traverse((object) => object.isMesh && meshes.push(object));
    for (const mesh of meshes) {
        mesh.material = mesh.material.clone();
        Object.assign(mesh.material, surface);
        mesh.material.color.setRGB(0.9, 0.5, 0.2);
    }
    const { asset } = relightable;
    // Normals of all kinds: matrices of golden assets mean nothing anyway.
    meshes.forEach((mesh, i) => {
        const { normals, vertexCount } = asset.primitives[i];
        for (let vertex = 0; vertex < vertexCount; ++vertex) {
            const normal = new three.Vector3(Math.sin(3 * vertex), 0.8, Math.cos(2 * vertex)).normalize().toArray();
            normals.set(normal, 3 * vertex);
            mesh.geometry.attributes.normal.setXYZ(vertex, ...normal);
        }
    });
    const again = new Relightable(asset, meshes);
    again.setTransport(transport);
    again.setLighting(parseLighting(lighting));
    const perspective = new three.PerspectiveCamera(40, 1, 0.1, 1000);
    perspective.position.copy(camera.position);
    perspective.lookAt(new three.Box3().setFromObject(gltf.scene).getCenter(new three.Vector3()));
    const byShader = pixelsOf(gltf.scene, perspective);

    const index = asset.header.layers.findIndex((layer) => layer.transport === transport);
    const layer = asset.header.layers[index];
    const lobes = makeLobeTable(surface.roughness, layer.incidentBandCount);
    meshes.forEach((mesh, i) => {
        const primitive = asset.primitives[i];
        const incident = receiveLight(layer, primitive.numbers[index], parseLighting(lighting));
        const colors = new Float32Array(3 * primitive.vertexCount);
        for (let vertex = 0; vertex < primitive.vertexCount; ++vertex) {
            const normal = new three.Vector3().fromArray(primitive.normals, 3 * vertex).normalize();
            const view = perspective.position.clone().sub(new three.Vector3().fromBufferAttribute(mesh.geometry.attributes.position, vertex)).normalize();
            const first = 3 * vertex * layer.incidentBandCount ** 2;
            const exit = reflect(incident, first, layer.incidentBandCount, normal.toArray(), view.toArray(), lobes, surface.metalness);
            [0.9, 0.5, 0.2].forEach((base, c) => (colors[3 * vertex + c] = base * exit.perBaseColor[c] + exit.constant[c]));
        }
        mesh.geometry.setAttribute('color', new three.BufferAttribute(colors, 3));
        mesh.material = new three.MeshBasicMaterial({ vertexColors: true });
    });
    return { byShader, onCpu: pixelsOf(gltf.scene, perspective) };
};

/** Pixels before the context is lost, and after it is restored. */
window.drawThroughLoss = async (url, lighting) => {
    const gltf = await load(url, {});
    relightableOf(gltf).setLighting(parseLighting(lighting));
    const camera = cameraFor(gltf.scene);
    const before = pixelsOf(gltf.scene, camera);
    const happened = (name) => new Promise((resolve) => renderer.domElement.addEventListener(name, resolve, { once: true }));
    const lost = happened('webglcontextlost');
    renderer.forceContextLoss();
    await lost;
    const restored = happened('webglcontextrestored');
    await new Promise((resolve) => setTimeout(resolve, 50));
    renderer.forceContextRestore();
    await restored;
    return { before, after: pixelsOf(gltf.scene, camera) };
};

/** What relightableOf says of the glTF without its extension. */
window.loadPlain = async (bytes) => {
    const loader = new GLTFLoader();
    loader.register((parser) => new OpenPrtPlugin(parser));
    const gltf = await loader.parseAsync(new Uint8Array(bytes).buffer, '');
    try {
        return relightableOf(gltf);
    } catch (error) {
        return `${gltf.scene.children.length} nodes; ${error.message}`;
    }
};

/** Runs code as a module, in which there is a scene. @returns  what is then in the scene and how it is lit */
window.runModule = async (code) => {
    window.scene = new three.Scene();
    await import(URL.createObjectURL(new Blob([code], { type: 'text/javascript' })));
    const pixels = pixelsOf(window.scene, cameraFor(window.scene));
    return pixels.filter((value, i) => i % 4 < 3 && value > 0.01).length;
};

window.refusalOf = (bytes) =>
    new Promise((resolve) => {
        const loader = new GLTFLoader();
        loader.register((parser) => new OpenPrtPlugin(parser));
        loader.parse(new Uint8Array(bytes).buffer, '', () => resolve('nothing'), (error) => resolve(`${error.name}: ${error.message}`));
    });

window.isReady = true;
