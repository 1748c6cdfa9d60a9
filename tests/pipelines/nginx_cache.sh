#!/usr/bin/env bash
# A cache on nginx, with the location that examples/build.md prints: two folders share what one baked.
#   nginx_cache.sh SKYBAKE WORK_FOLDER PAGE     exit code 77 where nginx is missing
page=$(realpath "$3")
export PATH=$PATH:/usr/sbin
command -v nginx >/dev/null || { echo "skipped: there is no nginx (Debian's nginx-light)"; exit 77; }
source "$(dirname "$0")/common.sh"
export no_proxy=127.0.0.1
unset SKYBAKE_CACHE SKYBAKE_CACHE_DIR

location=$(sed -n '/^```nginx$/,/^```$/p' "$page" | sed '/^```/d' | sed "s|/srv/cache|$PWD/srv|")
[[ $location == *dav_methods* ]] || fail "the page prints no location"
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
mkdir srv temporary
cat >nginx.conf <<CONF
daemon off;
worker_processes 2;
user $(id -un) $(id -gn);
pid $PWD/nginx.pid;
error_log $PWD/error_log;
events {}
http {
    access_log $PWD/access_log;
    client_body_temp_path $PWD/temporary/body;
    proxy_temp_path $PWD/temporary/proxy;
    fastcgi_temp_path $PWD/temporary/fastcgi;
    uwsgi_temp_path $PWD/temporary/uwsgi;
    scgi_temp_path $PWD/temporary/scgi;
    server {
        listen 127.0.0.1:$port;
        $location
    }
}
CONF
nginx -c "$PWD/nginx.conf" -p "$PWD" 2>>error_log &
server=$!
trap 'kill $server' EXIT
until (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do
    kill -0 $server || fail "nginx: $(cat error_log)"
    sleep 0.05
done

url=http://127.0.0.1:$port/skybake
cached() { bake a "$1" --cache "$url/deep/folder" 2>"$1.log" || fail "$(cat "$1.log")"; }
requests() { grep -c "\"$1 .* $2 " access_log || true; }
cached first
cached second
for folder in first second; do
    holds $folder a || fail "$(sums $folder)"
    ! grep W0305 $folder.log || fail "$(cat error_log)"
done
[[ $(requests PUT 201) == 12 && $(requests GET 404) == 5 && $(requests GET 200) == 12 ]] || fail "$(cat access_log)"
# A large file in several pieces, and one that was damaged on the disk.
large=(--set 'bake.wisps.size=[256,256,128]' --only wisps)
bake a large --cache "$url/large" "${large[@]}"
bake a large_again --cache "$url/large" "${large[@]}"
bake a large_alone "${large[@]}"
[[ "$(sums large)" == "$(sums large_alone)" && "$(sums large_again)" == "$(sums large_alone)" ]] || fail "large files differ"
file=$(find srv/skybake/large -type f -size +4M | head -n 1)
printf '\xa5' | dd of="$file" bs=1 seek=3000000 conv=notrunc status=none
bake a large_damaged --cache "$url/large" "${large[@]}" 2>damaged.log
grep -q 'W0305.*1 of its entries was damaged' damaged.log || fail "$(cat damaged.log)"
[[ "$(sums large_damaged)" == "$(sums large_alone)" ]] || fail "damage reached the output"
# An nginx that may only be read.
chmod -R a-w srv
sed -i 's/dav_methods PUT;/dav_methods OFF;/' nginx.conf
kill -HUP $server
put() { printf 'PUT /skybake/new HTTP/1.0\r\nContent-Length: 0\r\n\r\n' >&3 && head -n 1 <&3; }
until put 3<>"/dev/tcp/127.0.0.1/$port" | grep -q ' 405 '; do sleep 0.05; done
cached third
holds third a || fail "$(sums third)"
! grep W0305 third.log || fail "$(cat third.log)"
bake b fourth --cache "$url/deep/folder" 2>fourth.log
grep -q 'W0305.*PUT was answered by status 405' fourth.log || fail "$(cat fourth.log)"
echo "$(wc -l <access_log) requests"
