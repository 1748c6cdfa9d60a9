// What a camera in the air sees along `ray` where there is no cloud: the sky, the ground, and the sun, whose edge is
// `pixel` radians soft. Vectors to the sun and along rays have the length 1.
Light skybake_sky(TABLES, vec3 camera_m, vec3 ray, vec3 sun, float pixel) {
    float h = 0.001 * camera_m.z;
    Air air = air_along(GIVEN, h, ray, sun, 1000000.0, 40);
    if (!air.grounded) return air.light + air_sun_disc(ray, sun, air.through, pixel);
    float sun_s = (baked_ground_radius_km() + h) * sun.z + air.end_km * dot(ray, sun);
    return air.light + air.through * air_ground_light(SUN_TABLE, LIGHT_TABLE, sun_s);
}

// The air before a surface: what is seen of it is light + through * the surface's own light.
Air skybake_air(TABLES, vec3 camera_m, vec3 ray, vec3 sun, float distance_m) {
    return air_along(GIVEN, 0.001 * camera_m.z, ray, sun, 0.001 * distance_m, 12);
}
