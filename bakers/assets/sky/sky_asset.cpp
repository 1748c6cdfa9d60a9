#include "bakers/assets/sky/sky_asset.h"

#include "bakers/light/shared_light.h"
#include "bakers/math/relative_error.h"

namespace skybake {

std::vector<Need> light_needs(const config::Atmosphere& atmosphere, config::SkyOrders orders,
                              bool reads_sunlight) {
    std::vector<Need> needs;
    if (orders != config::SkyOrders::single) {
        needs.push_back(need_of(LightRequest{.atmosphere = atmosphere}));
    }
    if (reads_sunlight) needs.push_back(need_of(sunlight_request(atmosphere, orders)));
    return needs;
}

std::vector<Need> light_needs(const config::Parameters& parameters, config::SkyOrders orders,
                              bool reads_sunlight) {
    std::vector<Need> needs;
    for (const config::Atmosphere& packet : light_packets(parameters)) {
        for (Need& need : light_needs(packet, orders, reads_sunlight)) {
            needs.push_back(std::move(need));
        }
    }
    return needs;
}

AccuracyRequest sky_table_request(const std::array<int, 2>& size) {
    AccuracyRequest request;
    request.size = size;
    request.quick = {256, 1};
    request.full = {4096, 1};
    request.quick_search = {36, 56, 6, 6, 56};
    request.full_search = {512, 256, 64, 32, 4096};
    return request;
}

void describe_sky_table(Baked& table) {
    table.conventions.angle_unit = "deg";
    table.conventions.radiance_unit = "1/sr";
    table.conventions.solar_irradiance.assign(table.channel_names.size(), 1);
    table.certificate.reference = "quadrature of each ray, exact sunlight and transmittance";
    table.certificate.scale = kRelativeErrorScale;
}

}  // namespace skybake
