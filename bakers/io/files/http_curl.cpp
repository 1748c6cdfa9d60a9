// The function that the module skybake_http exports: requests by libcurl.
#include <curl/curl.h>

#include <array>
#include <memory>

#include "bakers/io/files/http.h"

namespace skybake {
namespace {

constexpr long slowest_bytes_per_s = 1024;
// Pages of errors are read up to this size and forgotten, so that the connection can be used again.
constexpr std::size_t largest_error_page = std::size_t{64} << 10;

struct Transfer {
    const HttpRequest& request;
    CURL* handle = nullptr;
    std::size_t error_page_bytes = 0;
};

int status_of(CURL* handle) {
    long status = 0;
    curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status);
    return static_cast<int>(status);
}

// Returns how many bytes were used; libcurl ends the transfer if these are fewer than all.
std::size_t receive(char* bytes, std::size_t, std::size_t count, void* user) {
    auto& transfer = *static_cast<Transfer*>(user);
    if (status_of(transfer.handle) == 200 && transfer.request.receive) {
        return transfer.request.receive({bytes, count}) ? count : CURL_WRITEFUNC_ERROR;
    }
    transfer.error_page_bytes += count;
    return transfer.error_page_bytes <= largest_error_page ? count : CURL_WRITEFUNC_ERROR;
}

std::size_t send(char* bytes, std::size_t size, std::size_t count, void* user) {
    const auto sent = static_cast<Transfer*>(user)->request.send(bytes, size * count);
    return sent ? *sent : CURL_READFUNC_ABORT;
}

int watch(void* user, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
    const HttpRequest& request = static_cast<Transfer*>(user)->request;
    return request.cancelled && request.cancelled() ? 1 : 0;
}

long milliseconds(double seconds) { return static_cast<long>(seconds * 1000) + 1; }

void set_options(CURL* handle, Transfer& transfer) {
    const HttpRequest& request = transfer.request;
    curl_easy_setopt(handle, CURLOPT_URL, request.url.c_str());
    curl_easy_setopt(handle, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(handle, CURLOPT_FOLLOWLOCATION, 0L);
    curl_easy_setopt(handle, CURLOPT_NETRC, static_cast<long>(CURL_NETRC_OPTIONAL));
    curl_easy_setopt(handle, CURLOPT_USERAGENT, "skybake");
    curl_easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
    // Nobody waits for the end of a search for a host's address that takes too long.
    curl_easy_setopt(handle, CURLOPT_QUICK_EXIT, 1L);
    curl_easy_setopt(handle, CURLOPT_CONNECTTIMEOUT_MS, milliseconds(request.connect_s));
    curl_easy_setopt(handle, CURLOPT_TIMEOUT_MS, milliseconds(request.seconds));
    curl_easy_setopt(handle, CURLOPT_LOW_SPEED_LIMIT, slowest_bytes_per_s);
    curl_easy_setopt(handle, CURLOPT_LOW_SPEED_TIME, milliseconds(request.silence_s) / 1000);
    curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, receive);
    curl_easy_setopt(handle, CURLOPT_WRITEDATA, &transfer);
    curl_easy_setopt(handle, CURLOPT_NOPROGRESS, 0L);
    curl_easy_setopt(handle, CURLOPT_XFERINFOFUNCTION, watch);
    curl_easy_setopt(handle, CURLOPT_XFERINFODATA, &transfer);
    if (!request.upload_bytes) return;
    curl_easy_setopt(handle, CURLOPT_UPLOAD, 1L);
    curl_easy_setopt(handle, CURLOPT_INFILESIZE_LARGE,
                     static_cast<curl_off_t>(*request.upload_bytes));
    curl_easy_setopt(handle, CURLOPT_READFUNCTION, send);
    curl_easy_setopt(handle, CURLOPT_READDATA, &transfer);
}

// The handle of this thread, which keeps its connections; null if there is no memory for one.
CURL* handle_of_thread() {
    static const CURLcode prepared = curl_global_init(CURL_GLOBAL_DEFAULT);
    if (prepared != CURLE_OK) return nullptr;
    thread_local const std::unique_ptr<CURL, decltype(&curl_easy_cleanup)> handle(
        curl_easy_init(), &curl_easy_cleanup);
    return handle.get();
}

HttpAnswer make(const HttpRequest& request) {
    CURL* const handle = handle_of_thread();
    if (handle == nullptr) return {0, "libcurl cannot be used"};
    Transfer transfer{request, handle};
    std::array<char, CURL_ERROR_SIZE> reason{};
    curl_easy_reset(handle);
    set_options(handle, transfer);
    curl_easy_setopt(handle, CURLOPT_ERRORBUFFER, reason.data());
    const CURLcode code = curl_easy_perform(handle);
    curl_easy_setopt(handle, CURLOPT_ERRORBUFFER, nullptr);
    HttpAnswer answer{status_of(handle), ""};
    if (code != CURLE_OK)
        answer.problem = reason[0] != 0 ? reason.data() : curl_easy_strerror(code);
    return answer;
}

}  // namespace
}  // namespace skybake

extern "C" skybake::HttpFunction skybake_http() { return &skybake::make; }
