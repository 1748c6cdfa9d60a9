#!/usr/bin/env python3
"""A web server with GET and PUT for tests of caches.

    cache_server.py FOLDER     prints its port, and serves FOLDER until its standard input ends

The first part of a path says how it misbehaves, and the second part is the folder: /right/a/KEY.json. Each request
is a line of FOLDER/requests.
"""
import base64
import http.server
import os
import sys
import threading
import time

folder = sys.argv[1]
ended = threading.Event()


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def place(self):
        """Returns the mode and the file of the path."""
        mode, store, name = self.path.strip("/").split("/")
        with open(os.path.join(folder, "requests"), "a") as log:
            log.write(f"{mode} {self.command} {name}\n")
        os.makedirs(os.path.join(folder, store), exist_ok=True)
        return mode, os.path.join(folder, store, name)

    def answer(self, status, body=b"", claimed=None, headers=()):
        self.send_response(status)
        for name, value in headers:
            self.send_header(name, value)
        if claimed != "none":
            self.send_header("Content-Length", str(len(body) if claimed is None else claimed))
        self.end_headers()
        self.wfile.write(body)
        if claimed is not None:
            self.close_connection = True

    def answer_without_end(self, mode, body):
        """Sends as fast as the client takes it, and logs how much that was."""
        sent = 0
        try:
            self.answer(200, body, claimed="none")
            while not ended.is_set():
                self.wfile.write(b" " * 65536)
                sent += 65536
        finally:
            with open(os.path.join(folder, "sent"), "a") as log:
                log.write(f"{mode} {sent}\n")

    def is_let_in(self, mode):
        wanted = "Basic " + base64.b64encode(b"farm:s3cret").decode()
        return mode != "locked" or self.headers.get("Authorization") == wanted

    def do_PUT(self):
        mode, path = self.place()
        if mode in ("silent", "dribble"):
            ended.wait()
            return
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if mode == "sink":
            ended.wait()
        elif not self.is_let_in(mode):
            self.answer(401)
        elif mode in ("status403", "status500"):
            self.answer(int(mode[6:]), b"no")
        else:
            with open(path + ".new", "wb") as file:
                file.write(body)
            os.replace(path + ".new", path)
            self.answer(201)

    def do_GET(self):
        mode, path = self.place()
        if not self.is_let_in(mode):
            return self.answer(401)
        if mode == "status500":
            return self.answer(500, b"no" * 5000)
        if mode == "redirect":
            return self.answer(302, headers=[("Location", "file://" + path)])
        if mode == "garbage":
            self.wfile.write(b"\x00\xffgarbage: \r\n: : :\r\n\r\n" + os.urandom(500))
            self.close_connection = True
            return None
        if mode == "silent":
            return ended.wait()
        if mode == "others":  # the manifest of another asset
            names = sorted(name for name in os.listdir(os.path.dirname(path)) if name.endswith(".json"))
            name = os.path.basename(path)
            if name in names:
                path = os.path.join(os.path.dirname(path), names[names.index(name) - 1])
        if not os.path.exists(path):
            return self.answer(404, b"there is no such file")
        with open(path, "rb") as file:
            body = file.read()
        if mode == "dribble":  # 100 bytes a second
            self.answer(200, b"", claimed=len(body))
            for byte in body:
                if ended.wait(0.01):
                    return None
                self.wfile.write(bytes([byte]))
            return None
        is_file = not path.endswith(".json")
        if mode == "cut" and is_file:  # the connection ends too early
            return self.answer(200, body[: len(body) // 2], claimed=len(body))
        if mode == "short" and is_file:  # a truncated file that says so
            return self.answer(200, body[: len(body) // 2])
        if mode == "wrong" and is_file:
            return self.answer(200, body[:-1] + bytes([body[-1] ^ 1]))
        if mode == "wrong_manifest":
            return self.answer(200, body.replace(b'"bytes": ', b'"bytes": 1', 1))
        if mode == "no_json":
            return self.answer(200, b"<html>Please log in</html>")
        if mode == "endless" or (mode == "endless_files" and is_file):
            return self.answer_without_end(mode, body)
        if mode == "slow":  # right, after a while
            ended.wait(1.5)
        return self.answer(200, body)


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
server.handle_error = lambda *_: None  # clients hang up
server.daemon_threads = True
threading.Thread(target=server.serve_forever, daemon=True).start()
print(server.server_address[1], flush=True)
sys.stdin.read()
ended.set()
