// Draws assets for browser.test.ts, and compares the linear pixels.
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

function pixelsOf(scene, camera, into = target) {
    renderer.setRenderTarget(into);
    renderer.render(scene, camera);
    const pixels = new Float32Array(4 * into.width * into.height);
    renderer.readRenderTargetPixels(into, 0, 0, into.width, into.height, pixels);
    return pixels;
}

/** How many numbers of red, green and blue are seen. */
function countSeen(pixels) {
    return pixels.filter((value, i) => i % 4 < 3 && value > 0.01).length;
}

function largestDifference(a, b) {
    return a.reduce((largest, value, i) => Math.max(largest, Math.abs(value - b[i])), 0);
}

/** Loads an asset to be summed by the shader, and on the CPU, and compares each kind of transport under some lights. */
window.compareSums = async (url, lightings) => {
    const [byShader, onCpu] = await Promise.all(
        ['gpu', 'cpu'].map(async (mode) => {
            const { scene, userData } = await load(url, { mode, gloss: false });
            return { scene, relightable: relightableOf({ userData }), camera: cameraFor(scene) };
        }),
    );
    const result = { transports: byShader.relightable.transports, seen: 0, difference: 0 };
    for (const transport of result.transports) {
        const pictures = [byShader, onCpu].map(({ scene, relightable, camera }) => {
            relightable.setTransport(transport);
            return lightings.map((lighting) => {
                relightable.setLighting(parseLighting(lighting));
                return pixelsOf(scene, camera);
            });
        });
        pictures[0].forEach((pixels, light) => {
            result.seen += countSeen(pixels);
            result.difference = Math.max(result.difference, largestDifference(pixels, pictures[1][light]));
        });
    }
    byShader.relightable.dispose();
    onCpu.relightable.dispose();
    return result;
};

/** Compares a glossy layer by the shader with radiance that reflect() gave at the vertices; materials are as given. */
window.compareGloss = async (url, transport, lightings, surface) => {
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
    const perspective = new three.PerspectiveCamera(40, 1, 0.1, 1000);
    perspective.position.copy(camera.position);
    perspective.lookAt(new three.Box3().setFromObject(gltf.scene).getCenter(new three.Vector3()));
    const byShader = lightings.map((lighting) => {
        again.setLighting(parseLighting(lighting));
        return pixelsOf(gltf.scene, perspective);
    });

    const index = asset.header.layers.findIndex((layer) => layer.transport === transport);
    const layer = asset.header.layers[index];
    const lobes = makeLobeTable(surface.roughness, layer.incidentBandCount);
    const onCpu = lightings.map((lighting) => {
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
        return pixelsOf(gltf.scene, perspective).map((value) => Math.max(value, 0)); // as pixels cut it off
    });
    again.dispose();
    return {
        seen: byShader.reduce((sum, pixels) => sum + countSeen(pixels), 0),
        difference: Math.max(...byShader.map((pixels, light) => largestDifference(pixels, onCpu[light]))),
    };
};

/** Pixels of each kind of transport, red, green and blue, of a square from the origin to (metres, 0, metres), seen from above. */
window.drawFromAbove = async (base64, lighting, size, metres) => {
    const loader = new GLTFLoader();
    loader.register((parser) => new OpenPrtPlugin(parser));
    const gltf = await loader.parseAsync(Uint8Array.from(atob(base64), (character) => character.charCodeAt(0)).buffer, '');
    const relightable = relightableOf(gltf);
    relightable.setLighting(parseLighting(lighting));
    const camera = new three.OrthographicCamera(0, metres, 0, -metres, 1, 3);
    camera.position.y = 2;
    camera.rotation.x = -Math.PI / 2;
    const small = new three.WebGLRenderTarget(size, size, { type: three.FloatType });
    const pictures = {};
    for (const transport of relightable.transports) {
        relightable.setTransport(transport);
        const pixels = pixelsOf(gltf.scene, camera, small);
        // The first row is the lowest, at the largest z.
        pictures[transport] = Array.from({ length: size * size }, (_, k) => {
            const from = 4 * ((size - 1 - Math.floor(k / size)) * size + (k % size));
            return [...pixels.subarray(from, from + 3)];
        }).flat();
    }
    return pictures;
};

/** An asset and its copy, each under a light of its own, beside the same shown one after the other. */
window.compareClone = async (url, options, lightings) => {
    const lights = lightings.map(parseLighting);
    const { scene, userData } = await load(url, options);
    const camera = cameraFor(scene);
    const relightable = relightableOf({ userData });
    const expected = relightable.transports.map((transport) => {
        relightable.setTransport(transport);
        return lights.map((light) => {
            relightable.setLighting(light);
            return pixelsOf(scene, camera);
        });
    });
    const copy = scene.clone();
    const twin = relightable.cloneFor(scene, copy);
    const result = { seen: 0, difference: 0, transports: relightable.transports, leftAlone: 0 };
    relightable.transports.forEach((transport, t) => {
        relightable.setTransport(transport);
        twin.setTransport(transport);
        relightable.setLighting(lights[0]);
        twin.setLighting(lights[1]);
        [scene, copy].forEach((shown, i) => {
            const pixels = pixelsOf(shown, camera);
            result.seen += countSeen(pixels);
            result.difference = Math.max(result.difference, largestDifference(pixels, expected[t][i]));
        });
    });
    twin.dispose();
    result.leftAlone = largestDifference(pixelsOf(scene, camera), expected.at(-1)[0]);
    relightable.dispose();
    relightable.setLighting(lights[0]);
    result.again = largestDifference(pixelsOf(scene, camera), expected.at(-1)[0]);
    return result;
};

/** Compares pixels before the context is lost, and after it is restored. */
window.compareThroughLoss = async (url, lighting) => {
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
    return { seen: countSeen(before), difference: largestDifference(before, pixelsOf(gltf.scene, camera)) };
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
    return countSeen(pixelsOf(window.scene, cameraFor(window.scene)));
};

window.refusalOf = (bytes) =>
    new Promise((resolve) => {
        const loader = new GLTFLoader();
        loader.register((parser) => new OpenPrtPlugin(parser));
        loader.parse(new Uint8Array(bytes).buffer, '', () => resolve('nothing'), (error) => resolve(`${error.name}: ${error.message}`));
    });

window.isReady = true;
