/** WebGL2 of a canvas, or nothing where the browser has none. */
export function openGraphics(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
    return canvas.getContext('webgl2', { antialias: true, alpha: false, powerPreference: 'high-performance' });
}

/** Who draws. */
export function rendererName(gl: WebGL2RenderingContext): string {
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    return String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

/** Whether the CPU draws, which then had better not sum radiance in every frame. */
export function isSoftwareRasteriser(gl: WebGL2RenderingContext): boolean {
    return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(rendererName(gl));
}
