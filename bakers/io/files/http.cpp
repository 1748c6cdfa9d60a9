#include "bakers/io/files/http.h"

#include "bakers/io/files/load_module.h"

namespace skybake {

HttpAnswer make_request(const HttpRequest& request) {
    static const ModuleSymbol module = load_module(http_module_name, http_module_symbol);
    if (module.address == nullptr) return {0, module.reason};
    return reinterpret_cast<HttpModuleFunction>(module.address)()(request);
}

}  // namespace skybake
