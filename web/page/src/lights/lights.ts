import { type Lighting, type Mat3, applyWindow, deringingFactors, parseLighting, rotateLighting, rotationXyz, windowFactors, withBands } from 'openprt-three';

import { type LightEntry, takeBytes } from '../page_data.js';
import type { WindowName } from '../view_state.js';
import { chooseExposure } from './exposure.js';
import { type LightPicture, readPicture } from './light_picture.js';

/** A light that can be chosen. */
export class Light {
    private stops?: number;
    private readonly windowed = new Map<string, Lighting>();

    constructor(
        readonly name: string,
        readonly lighting: Lighting,
        readonly picture: LightPicture,
    ) {}

    /** Under which it is neither too bright nor too dark, however it is turned. */
    get exposureStops(): number {
        return (this.stops ??= chooseExposure(this.lighting));
    }

    /** The first bands of it, smoothed, and then turned. */
    prepare(bandCount: number, window: WindowName, rotation: Mat3): Lighting {
        const key = `${bandCount} ${window}`;
        const windowed = this.windowed.get(key) ?? smooth(withBands(this.lighting, bandCount), window);
        this.windowed.set(key, windowed);
        return rotateLighting(windowed, rotation);
    }
}

/** Of suns, little is left that is nowhere negative; that surfaces receive nothing negative costs far less. */
function smooth(lighting: Lighting, window: WindowName): Lighting {
    return applyWindow(lighting, window === 'auto' ? deringingFactors(lighting, 'irradiance') : windowFactors(window, lighting.bandCount));
}

/** The turn that the state tells of: about x, and then about +y. */
export function rotationOf({ tiltDegrees, turnDegrees }: { tiltDegrees: number; turnDegrees: number }): Mat3 {
    return rotationXyz(tiltDegrees, turnDegrees, 0);
}

/** The light that the page brings along at an index. */
export function takeLight({ name, lighting, picture }: LightEntry, index: number): Light {
    return new Light(name, parseLighting(lighting), readPicture(takeBytes(`prt-light-${index}`), picture.width, picture.height));
}
