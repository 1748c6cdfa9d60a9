export interface Asset {
    name: string;
    pixel_type: 'unorm8' | 'half' | 'float';
    channels: number;
    size: number[];
    axes: {wrap: string; filter: string}[];
    texels: Uint8Array | Uint16Array | Float32Array;
}
export interface Bake {
    manifest: unknown;
    assets: Asset[];
    glsl: string;
}
/** Loads a folder of skybake's. `to_z_up` is GLSL that turns a vector `v` of the engine's world into one whose z is up. */
export function load_bake(folder: string, to_z_up: string): Promise<Bake>;
export function texels_for_gpu(asset: Asset): Asset['texels'];
export function sun_direction(elevation_degrees: number, azimuth_degrees: number,
    from_z_up: (direction: [number, number, number]) => [number, number, number]): [number, number, number];
export function pixel_angle(vertical_field_radians: number, height: number): number;
export const picture_glsl: string;
