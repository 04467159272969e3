import { type AssetEntry, type View, takeBytes } from '../page_data.js';
import { type LoadedAsset, type Mode, disposeAsset, loadAsset } from './load_asset.js';

interface ShelvedAsset {
    name: string;
    view?: View;
    takeBytes: () => Uint8Array<ArrayBuffer>;
    loading?: Promise<LoadedAsset>;
    loaded?: LoadedAsset;
}

/** The assets that can be chosen, of which only those that are shown are parsed. */
export class AssetShelf {
    /** How long the last took to read. */
    loadMilliseconds = 0;
    private readonly assets: ShelvedAsset[];

    constructor(entries: readonly AssetEntry[], private readonly mode: Mode) {
        this.assets = entries.map(({ name, camera }, i) => {
            let bytes: Uint8Array<ArrayBuffer> | undefined;
            return { name, view: camera, takeBytes: () => (bytes ??= takeBytes(`prt-asset-${i}`)) };
        });
    }

    get names(): string[] {
        return this.assets.map(({ name }) => name);
    }

    /** Adds an asset that is parsed already, since only what can be shown is added. @returns  its index */
    async addFile(name: string, bytes: Uint8Array<ArrayBuffer>): Promise<number> {
        const loaded = await loadAsset(bytes, this.mode, undefined);
        return this.assets.push({ name, takeBytes: () => bytes, loaded, loading: Promise.resolve(loaded) }) - 1;
    }

    /** What was loaded of it and not let go of. */
    find(index: number): LoadedAsset | undefined {
        return this.assets[index]?.loaded;
    }

    /** Parses it, if that is not done yet. @throws  what says why it cannot be shown */
    load(index: number): Promise<LoadedAsset> {
        const asset = this.assets[index];
        return (asset.loading ??= this.parse(asset));
    }

    /** Lets go of all others; their bytes stay. */
    keepOnly(indices: readonly number[]): void {
        this.assets.forEach((asset, i) => {
            if (!asset.loaded || indices.includes(i)) return;
            disposeAsset(asset.loaded);
            delete asset.loaded;
            delete asset.loading;
        });
    }

    private async parse(asset: ShelvedAsset): Promise<LoadedAsset> {
        const begin = performance.now();
        try {
            asset.loaded = await loadAsset(asset.takeBytes(), this.mode, asset.view);
            this.loadMilliseconds = performance.now() - begin;
            return asset.loaded;
        } catch (error) {
            delete asset.loading;
            throw error;
        }
    }
}
