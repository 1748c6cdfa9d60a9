import type {Camera, IUniform, Material, Mesh, Texture, WebGLRenderer} from 'three';
export class Skybake {
    static load(folder: string): Promise<Skybake>;
    readonly manifest: unknown;
    /** Declares the uniforms, and has sky(ray), air(ray, distance), clouds(ray), seen(ray, noise) and shown_by_film(light). */
    readonly glsl: string;
    readonly textures: Record<string, Texture>;
    readonly uniforms: Record<string, IUniform>;
    set_sun(elevation_degrees: number, azimuth_degrees: number): void;
    update(camera: Camera, renderer: WebGLRenderer): void;
    background(): Mesh;
    add_air<M extends Material>(material: M): M;
}
