// What a ray sees of clouds.
struct Clouds {
    Light light;       // of the clouds and of the air before them
    float through;     // the share of what is behind them that is seen
    float distance_m;  // the mean distance of what is seen of them
};

// The phase function of droplets of 12 um or of ice, in 1/sr: Henyey-Greenstein's function with phase.x and Draine's with
// phase.y and phase.z, of which the share is phase.w (Jendersie and d'Eon 2023; Key et al. 2002). `offset` is 1 - cosine
// of the angle. Light that is scattered n more times sees it wider by 2^-n (Wrenninge et al. 2013).
float cloud_peak(float g, float offset) {
    float apart = (1.0 - g) * (1.0 - g) + 2.0 * g * offset;
    return 0.0795774715 * (1.0 - g * g) / (apart * sqrt(apart));
}
float cloud_phase(vec4 phase, float offset, float wide) {
    float g = phase.y * wide, alpha = phase.z * wide, cosine = 1.0 - offset;
    float draine = cloud_peak(g, offset) * (1.0 + alpha * cosine * cosine) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
    return mix(cloud_peak(phase.x * wide, offset), draine, phase.w);
}

// What light that is scattered 0 to 3 and 4 to 7 more times adds, where no cloud takes any of it.
struct CloudOctaves {
    vec4 few;
    vec4 many;
};

CloudOctaves cloud_octaves(vec4 phase, vec3 ray, vec3 sun) {
    float offset = 0.5 * dot(ray - sun, ray - sun);
    CloudOctaves octaves;
    octaves.few = vec4(cloud_phase(phase, offset, 1.0), cloud_phase(phase, offset, 0.5), cloud_phase(phase, offset, 0.25),
                       cloud_phase(phase, offset, 0.125)) * vec4(1.0, 0.7, 0.49, 0.343);
    octaves.many = vec4(cloud_phase(phase, offset, 0.0625), cloud_phase(phase, offset, 0.03125), cloud_phase(phase, offset, 0.015625),
                        cloud_phase(phase, offset, 0.0078125)) * vec4(0.2401, 0.16807, 0.117649, 0.0823543);
    return octaves;
}

float cloud_sunlit(CloudOctaves octaves, float depth) {
    vec4 few = exp(-depth * vec4(1.0, 0.5, 0.25, 0.125));
    vec4 many = exp(-depth * vec4(0.0625, 0.03125, 0.015625, 0.0078125));
    return dot(octaves.few, few) + dot(octaves.many, many);
}

// Samples lie at u (1 + growth u) steps with u = k + noise, so that they are as far apart as pixels are. Returns the u
// of a distance in steps.
float cloud_samples_to(float distance, float growth) {
    return 2.0 * max(distance, 0.0) / (1.0 + sqrt(1.0 + 4.0 * growth * max(distance, 0.0)));
}

// What is seen of two layers of clouds, whichever of them is nearer.
Clouds cloud_both(Clouds one, Clouds other) {
    Clouds near = one, far = other, seen;
    if (other.through < 1.0 && (one.through >= 1.0 || other.distance_m < one.distance_m)) {
        near = other;
        far = one;
    }
    float opacity = 1.0 - near.through, behind = near.through * (1.0 - far.through);
    seen.light = near.light + near.through * far.light;
    seen.through = near.through * far.through;
    seen.distance_m = (opacity * near.distance_m + behind * far.distance_m) / max(opacity + behind, 0.000000001);
    return seen;
}
