import type {BaseTexture, Effect, Mesh, PBRBaseMaterial, Scene, StandardMaterial, ShaderMaterial, Vector3} from '@babylonjs/core';
export class Skybake {
    static load(folder: string, scene: Scene): Promise<Skybake>;
    readonly manifest: unknown;
    /** Declares the uniforms, and has sky(ray), air(ray, distance), clouds(ray), seen(ray, noise) and shown_by_film(light). */
    readonly glsl: string;
    readonly textures: Record<string, BaseTexture>;
    readonly scene: Scene;
    exposure: number;
    sun: Vector3;
    set_sun(elevation_degrees: number, azimuth_degrees: number): void;
    bind(material: ShaderMaterial | Effect): void;
    background(): Mesh;
    add_air<M extends StandardMaterial | PBRBaseMaterial>(material: M): M;
}
