import type { BufferGeometry, Mesh } from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

import type { MeshoptDecoder } from './asset/gltf_document.js';
import { kExtension } from './asset/header.js';
import { type Asset, isAsset, readAssetParts } from './asset/read_asset.js';
import { OpenPrtError } from './error.js';
import { type RelightOptions, Relightable } from './relightable.js';

const kUserDataKey = 'openPrt';

/**
 * A plugin of three.js's GLTFLoader, which reads and checks the extension and makes the scene relightable:
 *
 *   loader.register((parser) => new OpenPrtPlugin(parser));
 *   const relightable = relightableOf(await loader.loadAsync('scene.prt.glb'));
 *
 * A damaged asset fails to load, with an OpenPrtError; of a plain glTF nothing is changed.
 */
export class OpenPrtPlugin implements GLTFLoaderPlugin {
    readonly name = kExtension;
    private asset?: Asset;

    constructor(
        private readonly parser: GLTFParser,
        private readonly options: RelightOptions = {},
    ) {}

    /** Reads transfer, and takes its attributes away: three.js need not load them too. */
    async beforeRoot(): Promise<void> {
        const { json } = this.parser;
        if (!isAsset(json)) return;
        const meshoptDecoder = this.parser.options.meshoptDecoder as MeshoptDecoder | undefined;
        await meshoptDecoder?.ready;
        const buffers: (Uint8Array | undefined)[] = await Promise.all(
            (json.buffers ?? []).map(async (buffer: { uri?: string }, i: number) =>
                buffer.uri === undefined && i > 0 ? undefined : new Uint8Array(await this.parser.getDependency('buffer', i)),
            ),
        );
        this.asset = readAssetParts(json, buffers, meshoptDecoder ? { meshoptDecoder } : {});
        for (const { primitives } of json.meshes)
            for (const { attributes } of primitives)
                for (const name of Object.keys(attributes)) if (name.startsWith('_PRT_')) delete attributes[name];
    }

    async afterRoot(gltf: GLTF): Promise<void> {
        const { asset } = this;
        if (!asset) return;
        const meshes = new Map<string, Mesh<BufferGeometry>>();
        gltf.scene.traverse((object) => {
            const place = this.parser.associations.get(object);
            if (place?.meshes !== undefined && (object as Mesh).isMesh) meshes.set(`${place.meshes} ${place.primitives ?? 0}`, object as Mesh<BufferGeometry>);
        });
        const shown = asset.primitives.map(({ mesh, primitive }) => {
            const found = meshes.get(`${mesh} ${primitive}`);
            if (!found) throw new OpenPrtError('malformed', `primitive ${primitive} of mesh ${mesh} is not among what three.js loaded`);
            return found;
        });
        gltf.userData[kUserDataKey] = new Relightable(asset, shown, this.options);
    }
}

/** What the plugin made of a loaded glTF. @throws OpenPrtError  where it has no radiance transfer */
export function relightableOf(gltf: GLTF): Relightable {
    const relightable: unknown = gltf.userData[kUserDataKey];
    if (!(relightable instanceof Relightable))
        throw new OpenPrtError('unsupported', `the file has no radiance transfer (${kExtension}): bake it first, with prt bake`);
    return relightable;
}
