// Shows an asset that prt baked, and turns the light:  /?scene=URL&light=URL
import { type Lighting, OpenPrtPlugin, addLighting, relightableOf, rotateLighting, rotationXyz, sunDirection, sunLighting, uniformLighting } from 'openprt-three';
import { NeutralToneMapping, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

import { loadLight } from './load_light.js';
import { placeCamera } from './place_camera.js';

const message = document.querySelector<HTMLElement>('#message')!;
const turn = document.querySelector<HTMLInputElement>('#turn')!;
const parameters = new URLSearchParams(location.search);
const sceneUrl = parameters.get('scene') ?? 'scene.prt.glb';
const lightUrl = parameters.get('light');

try {
    await show();
} catch (error) {
    message.textContent = `The scene cannot be shown. ${error instanceof Error ? error.message : String(error)}`;
}

async function show(): Promise<void> {
    const renderer = new WebGLRenderer({ antialias: true });
    renderer.toneMapping = NeutralToneMapping;
    document.body.prepend(renderer.domElement);

    // The plugin makes GLTFLoader read transfer; a decoder is needed after `prt compress --meshopt` alone.
    const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
    loader.register((parser) => new OpenPrtPlugin(parser));
    const gltf = await loader.loadAsync(sceneUrl, ({ loaded, total }) => (message.textContent = `Loading: ${describe(loaded, total)}`));
    const asset = relightableOf(gltf);
    const scene = new Scene().add(gltf.scene);

    const light = lightUrl ? await loadLight(lightUrl, asset.bandCount) : makeLight(asset.bandCount);
    message.textContent = '';

    const camera = new PerspectiveCamera();
    const controls = new OrbitControls(camera, renderer.domElement);
    const draw = (): void => renderer.render(scene, camera);
    const fit = (): void => {
        renderer.setPixelRatio(devicePixelRatio);
        renderer.setSize(innerWidth, innerHeight);
        camera.aspect = innerWidth / innerHeight;
        camera.updateProjectionMatrix();
        draw();
    };
    const relight = (): void => {
        asset.setLighting(rotateLighting(light, rotationXyz(0, Number(turn.value), 0)));
        draw();
    };
    placeCamera(camera, controls, gltf);
    controls.addEventListener('change', draw);
    turn.addEventListener('input', relight);
    addEventListener('resize', fit);
    fit();
    relight();
}

/** A sun and a pale sky. */
function makeLight(bandCount: number): Lighting {
    return addLighting(sunLighting(sunDirection(60, 45), 0.1, bandCount), uniformLighting([0.2, 0.25, 0.3], bandCount));
}

function describe(loaded: number, total: number): string {
    return total > 0 ? `${Math.round((100 * loaded) / total)} %` : `${Math.round(loaded / 1000)} kB`;
}
