// Requests to web servers, and the interface of the module that makes them.
//
// libcurl loads some 30 libraries, which a bake without a server does not need. Only the module
// skybake_http uses it, and it is loaded with the first request (load_module.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace skybake {

// One GET or PUT. Redirections are not followed. Credentials may stand in the URL or in ~/.netrc.
struct HttpRequest {
    std::string url;       // http:// or https://
    double seconds = 10;   // the request fails if it is not complete after this time
    double silence_s = 5;  // ... or if the server is silent, or slower than 1 KiB/s, for so long
    double connect_s = 3;  // ... or if there is no connection after this time
    std::function<bool()> cancelled = {};  // asked at least once a second; null: never
    // GET: receives the body of an answer of status 200, piece by piece. False ends the request.
    std::function<bool(std::string_view)> receive = {};
    // PUT: the size of the body, and what fills a buffer with up to `count` bytes of it and returns
    // how many; none ends the request.
    std::optional<std::uint64_t> upload_bytes = {};
    std::function<std::optional<std::size_t>(char* bytes, std::size_t count)> send = {};
};

struct HttpAnswer {
    int status = 0;       // of HTTP; 0: there was no answer
    std::string problem;  // why the request was not completed, in a few words; empty: it was
};

// Makes a request and waits for its end. Any number of threads may do so; each keeps its
// connections for its next requests. Without the module, the answer's problem says so.
HttpAnswer make_request(const HttpRequest& request);

// The module exports a function that returns the one which makes requests.
using HttpFunction = HttpAnswer (*)(const HttpRequest& request);
using HttpModuleFunction = HttpFunction (*)();
inline constexpr const char* http_module_symbol = "skybake_http";

}  // namespace skybake
