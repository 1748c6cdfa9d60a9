import type {BaseTexture, Mesh, Scene, ShaderMaterial, Vector3} from '@babylonjs/core';
export class Skybake {
    static load(folder: string, scene: Scene): Promise<Skybake>;
    readonly manifest: unknown;
    /** Declares the uniforms, and has sky(ray), air(ray, distance), clouds(ray), view(ray, noise) and shown_by_film(light). */
    readonly glsl: string;
    readonly textures: Record<string, BaseTexture>;
    readonly scene: Scene;
    exposure: number;
    sun: Vector3;
    set_sun(elevation_degrees: number, azimuth_degrees: number): void;
    bind(material: ShaderMaterial): void;
    background(): Mesh;
}
