import { type Lighting, parseLighting, projectTexture } from 'openprt-three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';

/** Projects a lat-long picture (.hdr, .exr), or reads the coefficients that `prt light --format json` wrote. */
export async function loadLight(url: string, bandCount: number): Promise<Lighting> {
    if (/\.hdr$/i.test(url)) return projectTexture(await new HDRLoader().loadAsync(url), bandCount);
    if (/\.exr$/i.test(url)) return projectTexture(await new EXRLoader().loadAsync(url), bandCount);
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url} is not there: ${response.status} ${response.statusText}`);
    return parseLighting(await response.json());
}
