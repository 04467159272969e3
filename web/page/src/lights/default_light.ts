import { addLighting, discLighting, sunDirection, uniformLighting } from 'openprt-three';

import { pictureOfCoefficients } from './light_picture.js';
import { Light } from './lights.js';

/** A wide window high up in a grey room, for a page that brings no light along. */
export function makeDefaultLight(): Light {
    const bandCount = 10;
    const lighting = addLighting(uniformLighting([0.3, 0.32, 0.36], bandCount), discLighting(sunDirection(60, 45), 0.7, [4, 3.7, 3.3], bandCount));
    return new Light('window', lighting, pictureOfCoefficients(lighting));
}
