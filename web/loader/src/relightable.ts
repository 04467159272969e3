import { BufferAttribute, type BufferGeometry, type DataTexture, DynamicDrawUsage, type Material, type Mesh } from 'three';

import type { Layer, Transport } from './asset/layer.js';
import type { Asset, AssetPrimitive } from './asset/read_asset.js';
import { OpenPrtError } from './error.js';
import { diffuseRow } from './relight/folded_light.js';
import { LayerLight } from './relight/layer_light.js';
import { relight } from './relight/relight.js';
import { kRadianceAttribute, makeRelightMaterial } from './relight/relight_material.js';
import { makeTransferTexture } from './relight/transfer_texture.js';
import { type Lighting, darkness } from './sh/lighting.js';

/** Where radiance is summed: at each frame on the GPU, or at each change of the light on the CPU, which a software rasteriser prefers. */
export type RelightMode = 'gpu' | 'cpu';

/** A primitive as three.js shows it. */
interface ShownMesh {
    mesh: Mesh<BufferGeometry>;
    primitive: AssetPrimitive;
    source: Material;
    /** What setTransport made for a layer. */
    made: Map<string, { material: Material; transfer?: DataTexture }>;
}

/** The meshes of a loaded asset, to be relit together. */
export class Relightable {
    private lighting: Lighting;
    private shownLayer: Layer;
    private readonly shown: ShownMesh[];
    private readonly lights = new Map<Layer, LayerLight>();

    /** @param meshes  one for each of the asset's primitives */
    constructor(
        readonly asset: Asset,
        meshes: readonly Mesh<BufferGeometry>[],
        readonly mode: RelightMode = 'gpu',
    ) {
        this.lighting = darkness(this.bandCount);
        this.shown = meshes.map((mesh, i) => ({ mesh, primitive: asset.primitives[i], source: mesh.material as Material, made: new Map() }));
        const { layers } = asset.header;
        const vectors = layers.filter(({ incidentBandCount }) => incidentBandCount === 0);
        this.shownLayer = [...vectors, ...layers.filter(diffuseRow)].at(vectors.length > 0 ? vectors.length - 1 : -1) ?? this.refuse();
        this.show(this.shownLayer);
    }

    /** n of the light that is made use of. */
    get bandCount(): number {
        return this.asset.header.bandCount;
    }

    /** The kinds of transport that can be shown; of matrices, what they say of diffuse surfaces. */
    get transports(): Transport[] {
        return this.asset.header.layers.filter(diffuseRow).map((layer) => layer.transport);
    }

    get transport(): Transport {
        return this.shownLayer.transport;
    }

    /** Shows another kind of transport; at first it is the fullest of vectors. */
    setTransport(transport: Transport): void {
        const layer = this.asset.header.layers.find((candidate) => candidate.transport === transport && diffuseRow(candidate));
        if (!layer) throw new OpenPrtError('invalidOption', `the asset cannot show ${transport} transport, but ${this.transports.join(', ')}`);
        this.show(layer);
    }

    /** @param lighting  in the frame of the scene: of a scene that is turned, turned the other way (rotateLighting) */
    setLighting(lighting: Lighting): void {
        this.lighting = lighting;
        this.light();
    }

    /** Radiance of a primitive's vertices before their albedo, three numbers a vertex, as computed on the CPU. */
    relight(primitive: number, lighting: Lighting = this.lighting): Float32Array {
        const index = this.asset.header.layers.indexOf(this.shownLayer);
        return relight(this.shownLayer, this.asset.primitives[primitive].numbers[index], lighting);
    }

    /** Frees what was made for the GPU, and gives the meshes their own materials back. */
    dispose(): void {
        for (const { mesh, source, made } of this.shown) {
            mesh.material = source;
            for (const { material, transfer } of made.values()) {
                material.dispose();
                transfer?.dispose();
            }
            made.clear();
        }
        this.lights.forEach((light) => light.dispose());
        this.lights.clear();
    }

    private refuse(): never {
        throw new OpenPrtError('unsupported', 'the asset has matrices of one incident band alone, which say nothing of diffuse surfaces');
    }

    private show(layer: Layer): void {
        this.shownLayer = layer;
        if (this.mode === 'gpu' && !this.lights.has(layer)) this.lights.set(layer, new LayerLight(layer, diffuseRow(layer)!));
        for (const shown of this.shown) shown.mesh.material = this.materialOf(shown, layer);
        this.light();
    }

    private materialOf({ primitive, source, made, mesh }: ShownMesh, layer: Layer): Material {
        const key = this.mode === 'gpu' ? layer.transport : 'cpu';
        const cached = made.get(key);
        if (cached) return cached.material;
        if (this.mode === 'cpu') {
            // three.js shares a geometry between primitives that differ in their transfer alone.
            if (mesh.geometry.hasAttribute(kRadianceAttribute)) mesh.geometry = mesh.geometry.clone();
            const radiance = new BufferAttribute(new Float32Array(3 * primitive.vertexCount), 3).setUsage(DynamicDrawUsage);
            mesh.geometry.setAttribute(kRadianceAttribute, radiance);
            const material = makeRelightMaterial(source);
            made.set(key, { material });
            return material;
        }
        const light = this.lights.get(layer)!;
        const numbers = primitive.numbers[this.asset.header.layers.indexOf(layer)];
        const transfer = makeTransferTexture(layer, numbers, light.attributes);
        const material = makeRelightMaterial(source, light, transfer);
        made.set(key, { material, transfer });
        return material;
    }

    private light(): void {
        if (this.mode === 'gpu') {
            this.lights.get(this.shownLayer)!.set(this.lighting);
            return;
        }
        const index = this.asset.header.layers.indexOf(this.shownLayer);
        for (const { mesh, primitive } of this.shown) {
            const attribute = mesh.geometry.getAttribute(kRadianceAttribute) as BufferAttribute;
            relight(this.shownLayer, primitive.numbers[index], this.lighting, attribute.array as Float32Array);
            attribute.needsUpdate = true;
        }
    }
}
