'use strict';
// A project of Godot in one file, as the program for the web reads it.
//
// Source: Godot 4.6, core/io/file_access_pack.h, version 2 of the format.
const crypto = require('node:crypto');

const magic = 'GDPC';
const version = 2;
const engine = [4, 6, 0];

const multiple = (number, of) => Math.ceil(number / of) * of;

// `files` are the names in the project, "dir/a.dds", and their bytes or text.
function packed(files) {
    const entries = Object.entries(files).map(([name, content]) => ({
        name: Buffer.from(`res://${name}`), bytes: Buffer.from(content)}));
    const padded = (name) => multiple(name.length, 4);
    const head = 4 * (1 + 1 + 3 + 1 + 2 + 16 + 1);
    const directory = entries.reduce((sum, {name}) => sum + 4 + padded(name) + 8 + 8 + 16 + 4, 0);
    const begin = multiple(head + directory, 16);
    const all = Buffer.alloc(entries.reduce((sum, {bytes}) => sum + multiple(bytes.length, 16), begin));
    all.write(magic, 0);
    [version, ...engine].forEach((number, i) => all.writeUInt32LE(number, 4 + 4 * i));
    all.writeBigUInt64LE(BigInt(begin), 24);
    all.writeUInt32LE(entries.length, head - 4);
    let at = head;
    let place = 0;
    for (const {name, bytes} of entries) {
        all.writeUInt32LE(padded(name), at);
        name.copy(all, at + 4);
        at += 4 + padded(name);
        all.writeBigUInt64LE(BigInt(place), at);
        all.writeBigUInt64LE(BigInt(bytes.length), at + 8);
        crypto.createHash('md5').update(bytes).digest().copy(all, at + 16);
        at += 36;
        bytes.copy(all, begin + place);
        place += multiple(bytes.length, 16);
    }
    return all;
}

module.exports = {packed};
