import { OpenPrtError, OpenPrtPlugin, type Relightable, readAsset, relightableOf } from 'openprt-three';
import { Box3, type Group, MathUtils, PerspectiveCamera, Sphere, Vector3 } from 'three';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

import type { View } from '../page_data.js';
import { frameBounds } from './frame_bounds.js';

/** An asset, parsed and ready to be drawn. */
export interface LoadedAsset {
    root: Group;
    relightable: Relightable;
    bounds: Sphere;
    view: View;
}

export type Mode = 'cpu' | 'gpu';

/**
 * Parses a binary glTF with radiance transfer.
 *
 * @param view  where the page says from where; else the asset's first camera, or all of it is in view
 * @throws      what says why it cannot be shown
 */
export async function loadAsset(bytes: Uint8Array<ArrayBuffer>, mode: Mode, view: View | undefined): Promise<LoadedAsset> {
    const loader = new GLTFLoader();
    loader.setMeshoptDecoder(MeshoptDecoder);
    loader.register((parser) => new OpenPrtPlugin(parser, { mode }));
    const gltf = await loader.parseAsync(bytes.buffer, '').catch((error: unknown) => {
        if (!(error instanceof OpenPrtError)) readAsset(bytes); // which knows better what is wrong with a file than three.js does
        throw error;
    });
    const relightable = relightableOf(gltf);
    const box = new Box3().setFromObject(gltf.scene);
    return {
        root: gltf.scene,
        relightable,
        bounds: box.getBoundingSphere(new Sphere()),
        view: view ?? viewOfCamera(gltf) ?? frameBounds(box),
    };
}

/** Frees what an asset has on the GPU. */
export function disposeAsset({ root, relightable }: LoadedAsset): void {
    relightable.dispose();
    root.traverse((object) => disposeOwn(object as Partial<Disposable3D>));
}

interface Disposable3D {
    geometry: { dispose(): void };
    material: { dispose(): void; map?: { dispose(): void } | null };
}

function disposeOwn({ geometry, material }: Partial<Disposable3D>): void {
    geometry?.dispose();
    material?.map?.dispose();
    material?.dispose();
}

function viewOfCamera({ scene, cameras }: GLTF): View | undefined {
    const camera = cameras.find((candidate) => candidate instanceof PerspectiveCamera);
    if (!camera) return undefined;
    scene.updateWorldMatrix(true, true);
    return {
        eye: camera.getWorldPosition(new Vector3()).toArray(),
        forward: camera.getWorldDirection(new Vector3()).toArray(),
        verticalFovDegrees: MathUtils.clamp(camera.fov, 1, 170),
    };
}
