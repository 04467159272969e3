import type { Mat3, Relightable, Transport } from 'openprt-three';
import { type Object3D, Scene } from 'three';

import type { LoadedAsset } from '../assets/load_asset.js';
import type { Light } from '../lights/lights.js';
import type { Side, WindowName } from '../view_state.js';

/** What a half shows of an asset, where its side leaves it open or asks for what the asset lacks. */
export interface Shown {
    transport: Transport;
    bands: number;
    window: WindowName;
}

export function chooseShown({ bandCount, transports }: Relightable, side: Side): Shown {
    return {
        transport: transports.find((transport) => transport === side.transport) ?? transports.at(-1)!,
        bands: Math.min(side.bands ?? bandCount, bandCount),
        window: side.window ?? 'auto',
    };
}

// Longer than this and a turn of the light stutters.
const kMostMilliseconds = 50;

/** One half of the picture: an asset, lit by itself. */
export class Pane {
    readonly scene = new Scene();
    private asset?: LoadedAsset | undefined;
    private root?: Object3D | undefined;
    private relightable?: Relightable | undefined;
    private light?: Light;
    private litBy = '';
    /** What it took to light this asset under each transport. */
    private readonly milliseconds = new Map<Transport, number>();

    /** @param isCopy  whether to show a copy of an asset, since the other half may show the asset itself */
    constructor(private readonly isCopy: boolean) {}

    show(asset: LoadedAsset): void {
        if (asset === this.asset) return;
        this.clear();
        this.asset = asset;
        this.root = this.isCopy ? asset.root.clone() : asset.root;
        this.relightable = this.isCopy ? asset.relightable.cloneFor(asset.root, this.root) : asset.relightable;
        this.scene.add(this.root);
    }

    clear(): void {
        if (this.root) this.scene.remove(this.root);
        if (this.isCopy) this.relightable?.dispose();
        this.asset = this.root = this.relightable = undefined;
        this.litBy = '';
        this.milliseconds.clear();
    }

    /**
     * Sums radiance anew where something of it has changed; turning the camera is none of that. While things move, transport that takes long
     * is stood in for by the fullest of diffuse surfaces.
     *
     * @returns  whether what is shown is what was asked for
     */
    relight(side: Side, light: Light, rotation: Mat3, isMoving: boolean): boolean {
        const { relightable } = this;
        if (!relightable) return true;
        const { transport, bands, window } = chooseShown(relightable, side);
        const key = [transport, bands, window, ...rotation].join();
        if (light === this.light && key === this.litBy) return true;
        const standIn = isMoving && this.isSlow(transport) ? relightable.transports.findLast((other) => !this.isSlow(other)) : undefined;
        const begin = performance.now();
        if (relightable.transport !== (standIn ?? transport)) relightable.setTransport(standIn ?? transport);
        relightable.setLighting(light.prepare(bands, window, rotation));
        if (standIn === undefined) this.milliseconds.set(transport, performance.now() - begin);
        this.light = light;
        this.litBy = standIn === undefined ? key : '';
        return standIn === undefined;
    }

    /** Whether its matrices are many for this machine. */
    private isSlow(transport: Transport): boolean {
        return transport.startsWith('glossy') && (this.milliseconds.get(transport) ?? 0) > kMostMilliseconds;
    }
}
