import { BufferAttribute, type BufferGeometry, type DataTexture, DynamicDrawUsage, type Material, type Mesh, type Object3D } from 'three';

import { type Layer, type StoredArray, type Transport, isGlossy } from './asset/layer.js';
import type { Asset, AssetPrimitive } from './asset/read_asset.js';
import { OpenPrtError } from './error.js';
import { diffuseRow } from './relight/folded_light.js';
import { GlossySurface } from './relight/glossy_surface.js';
import { LayerLight } from './relight/layer_light.js';
import { relight } from './relight/relight.js';
import { kRadianceAttribute, kRadianceOfAttribute, makeRelightMaterial, sumRadiance } from './relight/relight_material.js';
import { type Surface, makeLobeTexture, surfaceOf } from './relight/surface.js';
import { makeTransferTexture } from './relight/transfer_texture.js';
import { computeUnshadowed, makeUnshadowedLayer } from './relight/unshadowed.js';
import { type Lighting, darkness } from './sh/lighting.js';

export interface RelightOptions {
    /** Where radiance is summed: at each frame on the GPU, or at each change of the light on the CPU, which a software rasteriser prefers. */
    mode?: 'gpu' | 'cpu';
    /** Whether surfaces shine under glossy transport; else it shows what it says of diffuse ones. */
    gloss?: boolean;
}

/** A primitive as three.js shows it. */
interface ShownMesh {
    mesh: Mesh<BufferGeometry>;
    primitive: AssetPrimitive;
    source: Material;
    /** Transfer that its normals tell; found when it is first shown. */
    unshadowed?: Float32Array;
    /** What setTransport made for a layer. */
    made: Map<string, MadeMaterial>;
}

interface MadeMaterial {
    material: Material;
    transfer?: DataTexture;
    surface?: GlossySurface;
}

/** The meshes of a loaded asset, to be relit together. */
export class Relightable {
    private lighting: Lighting;
    private shownLayer: Layer;
    /** Those that can be shown: the asset's, and what normals tell. */
    private readonly layers: readonly Layer[];
    private readonly shown: ShownMesh[];
    private readonly lights = new Map<Layer, LayerLight>();
    private readonly lobes = new Map<string, DataTexture>();
    private readonly isOnCpu: boolean;
    private readonly hasGloss: boolean;

    /** @param meshes  one for each of the asset's primitives */
    constructor(
        readonly asset: Asset,
        meshes: readonly Mesh<BufferGeometry>[],
        private readonly options: RelightOptions = {},
    ) {
        const { mode = 'gpu', gloss = true } = options;
        this.isOnCpu = mode === 'cpu';
        this.hasGloss = gloss;
        this.lighting = darkness(this.bandCount);
        this.shown = meshes.map((mesh, i) => ({ mesh, primitive: asset.primitives[i], source: mesh.material as Material, made: new Map() }));
        const stored = asset.header.layers.filter((layer) => this.canShow(layer));
        const fullest = stored.at(-1);
        if (!fullest) throw new OpenPrtError('unsupported', 'the asset has matrices of one incident band alone, which say nothing of diffuse surfaces');
        this.layers = stored[0].transport === 'unshadowed' ? stored : [makeUnshadowedLayer(this.bandCount), ...stored];
        this.shownLayer = fullest;
        this.show(fullest);
    }

    /** n of the light that is made use of. */
    get bandCount(): number {
        return this.asset.header.bandCount;
    }

    /** The kinds of transport that can be shown. The first, `unshadowed`, always is: where the asset has no such layer, its normals tell it. */
    get transports(): Transport[] {
        return this.layers.map((layer) => layer.transport);
    }

    get transport(): Transport {
        return this.shownLayer.transport;
    }

    /** Shows another kind of transport; at first it is the fullest. */
    setTransport(transport: Transport): void {
        const layer = this.layers.find((candidate) => candidate.transport === transport);
        if (!layer) throw new OpenPrtError('invalidOption', `the asset cannot show ${transport} transport, but ${this.transports.join(', ')}`);
        this.show(layer);
    }

    /** @param lighting  in the frame of the scene: of a scene that is turned, turned the other way (rotateLighting) */
    setLighting(lighting: Lighting): void {
        this.lighting = lighting;
        this.show(this.shownLayer);
    }

    /** The same asset once more, to be lit and shown by itself. @param copy  what `root.clone()` made of an object above the meshes */
    cloneFor(root: Object3D, copy: Object3D): Relightable {
        const originals = listObjects(root);
        const copies = listObjects(copy);
        const meshes = this.shown.map(({ mesh, source }) => {
            const twin = copies[originals.indexOf(mesh)] as Mesh<BufferGeometry>;
            twin.material = source;
            return twin;
        });
        return new Relightable(this.asset, meshes, this.options);
    }

    /** Frees what was made for the GPU, and gives the meshes their own materials back, until they are lit again. */
    dispose(): void {
        for (const { mesh, source, made } of this.shown) {
            mesh.material = source;
            mesh.geometry.deleteAttribute(kRadianceAttribute);
            for (const { material, transfer, surface } of made.values()) {
                material.dispose();
                transfer?.dispose();
                surface?.dispose();
            }
            made.clear();
        }
        for (const resources of [this.lights, this.lobes]) {
            resources.forEach((resource) => resource.dispose());
            resources.clear();
        }
    }

    private shines(layer: Layer): boolean {
        return this.hasGloss && isGlossy(layer.transport);
    }

    private canShow(layer: Layer): boolean {
        return this.shines(layer) || diffuseRow(layer) !== undefined;
    }

    private show(layer: Layer): void {
        this.shownLayer = layer;
        for (const shown of this.shown) {
            const key = this.isOnCpu && !this.shines(layer) ? 'cpu' : layer.transport;
            const made = shown.made.get(key) ?? this.make(shown, layer);
            shown.made.set(key, made);
            shown.mesh.material = made.material;
        }
        this.light();
    }

    private numbersOf(shown: ShownMesh, layer: Layer): StoredArray {
        const index = this.asset.header.layers.indexOf(layer);
        return index >= 0 ? shown.primitive.numbers[index] : (shown.unshadowed ??= computeUnshadowed(layer, shown.primitive.normals));
    }

    private make(shown: ShownMesh, layer: Layer): MadeMaterial {
        const { mesh, primitive, source } = shown;
        const numbers = this.numbersOf(shown, layer);
        if (this.shines(layer)) {
            const look = surfaceOf(source);
            const surface = new GlossySurface(layer, numbers, this.lobesOf(look, layer.incidentBandCount), look);
            return { material: makeRelightMaterial(source, surface.radiance), surface };
        }
        if (this.isOnCpu) {
            // three.js shares a geometry between primitives that differ in their transfer alone.
            if (mesh.geometry.hasAttribute(kRadianceAttribute)) mesh.geometry = mesh.geometry.clone();
            const radiance = new BufferAttribute(new Float32Array(3 * primitive.vertexCount), 3).setUsage(DynamicDrawUsage);
            mesh.geometry.setAttribute(kRadianceAttribute, radiance);
            return { material: makeRelightMaterial(source, kRadianceOfAttribute) };
        }
        const light = this.lights.get(layer) ?? new LayerLight(layer, diffuseRow(layer)!);
        this.lights.set(layer, light);
        const transfer = makeTransferTexture(layer, numbers, light.attributes);
        return { material: makeRelightMaterial(source, sumRadiance(light, transfer)), transfer };
    }

    private lobesOf(surface: Surface, bandCount: number): DataTexture {
        const key = `${surface.texture ? 'all' : surface.roughness} ${bandCount}`;
        const lobes = this.lobes.get(key) ?? makeLobeTexture(surface, bandCount);
        this.lobes.set(key, lobes);
        return lobes;
    }

    private light(): void {
        const layer = this.shownLayer;
        if (this.shines(layer)) {
            for (const { made } of this.shown) made.get(layer.transport)!.surface!.set(this.lighting);
            return;
        }
        if (!this.isOnCpu) {
            this.lights.get(layer)!.set(this.lighting);
            return;
        }
        for (const shown of this.shown) {
            const attribute = shown.mesh.geometry.getAttribute(kRadianceAttribute) as BufferAttribute;
            relight(layer, this.numbersOf(shown, layer), this.lighting, attribute.array as Float32Array);
            attribute.needsUpdate = true;
        }
    }
}

/** An object and all below it, in an order that its clones have too. */
function listObjects(root: Object3D): Object3D[] {
    const objects: Object3D[] = [];
    root.traverse((object) => objects.push(object));
    return objects;
}
