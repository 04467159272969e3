/** WebGL2 of a canvas, or nothing where the browser has none. Without multisampling where the CPU draws, which it takes twice as long. */
export function openGraphics(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
    const probe = document.createElement('canvas').getContext('webgl2');
    if (!probe) return null;
    const antialias = !isSoftwareRasteriser(probe);
    probe.getExtension('WEBGL_lose_context')?.loseContext();
    return canvas.getContext('webgl2', { antialias, alpha: false, powerPreference: 'high-performance' });
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
