#include <map>
#include <mutex>
#include <tuple>

#include "bakers/air/particles/particle_scattering.h"

namespace skybake {

namespace {

// All that the result depends on.
auto key_of(const config::Particles& particles, config::Length wavelength, double accuracy) {
    return std::tuple{particles.material,
                      particles.refractive_index,
                      particles.absorption_index,
                      particles.sizes,
                      particles.radius.meters,
                      particles.geometric_deviation,
                      particles.effective_radius.meters,
                      particles.effective_variance,
                      particles.alpha,
                      particles.gamma,
                      wavelength.meters,
                      accuracy};
}

using Key = decltype(key_of({}, {}, 0));
using Results = std::map<Key, std::shared_ptr<const ParticleScattering>>;

}  // namespace

std::shared_ptr<const ParticleScattering> remembered_particle_scattering(
    const config::Particles& particles, config::Length wavelength, double accuracy, int threads) {
    static std::mutex mutex;
    static Results results;
    const Key key = key_of(particles, wavelength, accuracy);
    {
        const std::lock_guard lock(mutex);
        const auto known = results.find(key);
        if (known != results.end()) return known->second;
    }
    // Not under the lock: a thread that waits inside parallel_for may be given another task of the
    // pool, which may ask for particles too.
    auto made = std::make_shared<const ParticleScattering>(
        particle_scattering(particles, wavelength, accuracy, threads));
    const std::lock_guard lock(mutex);
    return results.try_emplace(key, std::move(made)).first->second;
}

}  // namespace skybake
