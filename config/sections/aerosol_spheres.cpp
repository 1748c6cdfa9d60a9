#include "config/sections/aerosol_spheres.h"

namespace skybake::config {

Particles spheres_of(AerosolComponent component, double relative_humidity) {
    const double percent = relative_humidity * 100;
    const LogNormalRadii radii = radii_of(component, percent);
    Particles spheres;
    spheres.name = name_of(component);
    spheres.material = ParticleMaterial::tabulated;
    for (const Length wavelength : tabulated_wavelengths(component)) {
        const RefractiveIndex index = refractive_index_of(component, wavelength, percent);
        spheres.indices.push_back({wavelength, index.real, index.imaginary});
    }
    spheres.sizes = SizeDistribution::log_normal;
    spheres.radius = radii.mode_radius;
    spheres.geometric_deviation = radii.deviation;
    spheres.smallest_radius = radii.smallest;
    spheres.largest_radius = radii.largest;
    return spheres;
}

std::vector<SphereKind> kinds_of(AerosolMixture mixture, double relative_humidity) {
    std::vector<SphereKind> kinds;
    for (const MixturePart& part : parts_of(mixture)) {
        kinds.push_back({spheres_of(part.component, relative_humidity), part.particles});
    }
    return kinds;
}

}  // namespace skybake::config
