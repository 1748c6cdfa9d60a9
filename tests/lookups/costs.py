"""Counts what printed lookups cost, in SPIR-V that is optimised, and compares it with what they say.

    costs.py FOLDER        FOLDER/glsl has what `skybake info --lookup` prints of the bakes FOLDER/*, and
                           their manifests say the same (print_lookups.cmake)

A printed lookup may cost at most what it says, and of those that call the same published functions some
cost as much. A figure that is wrong is printed with the right one. No two lookups of a group need agree:
a camera on the ground saves what one in space pays.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FIGURES = ("fetches", "operations", "divisions", "special functions")
SAID = re.compile(r"fetches (\d+), operations (\d+), divisions (\d+), special functions (\d+)")
# Operations for each component of the result; those of an instruction that is in no list are refused.
ONE = set("FAdd FSub FMul FNegate IAdd ISub IMul VectorTimesScalar Select ConvertSToF ConvertFToS LogicalAnd LogicalOr "
          "LogicalNot FAbs SAbs FSign Floor FMin FMax SMin SMax".split())
MORE = {"Fma": 2, "FMix": 3, "FClamp": 2, "SClamp": 2, "Cross": 3}
SPECIAL = set("Sqrt InverseSqrt Atan2 Exp Log Pow".split())
FREE = set("Load Store AccessChain Constant ConstantComposite ConstantTrue ConstantFalse ConstantNull Undef Variable Label "
           "Function CompositeConstruct CompositeExtract CompositeInsert VectorShuffle Phi SampledImage Image "
           "INotEqual".split())  # the last one makes a bool of an input


def optimised(text):
    """The instructions of a fragment shader that shows what the printed function returns."""
    kind, name, parameters = re.search(r"^(float|vec[234]) (baked_\w+)\(([^)]*)\) \{", text, re.M).groups()
    inputs, given = "", []
    for i, (type_, word) in enumerate(re.findall(r"(\w+) (\w+)", parameters)):
        where = f"layout(binding = {i}) uniform" if "sampler" in type_ else f"layout(location = {i}) flat in"
        inputs += f"{where} {'int' if type_ == 'bool' else type_} in_{word};\n"
        given.append(f"in_{word}" + (" != 0" if type_ == "bool" else ""))
    shader = (f"#version 450\n{text}\n{inputs}layout(location = 0) out {kind} shown;\n"
              f"void main() {{ shown = {name}({', '.join(given)}); }}\n")
    with tempfile.TemporaryDirectory() as folder:
        binary = folder + "/lookup.spv"
        said = subprocess.run(["glslangValidator", "-V", "--stdin", "-S", "frag", "-o", binary], input=shader, text=True,
                              capture_output=True)
        if said.returncode or "WARNING" in said.stdout:
            sys.exit(f"{shader}{said.stdout}")
        subprocess.run(["spirv-opt", "-O", binary, "-o", binary], check=True)
        return subprocess.run(["spirv-dis", "--no-color", binary], check=True, capture_output=True, text=True).stdout


def cost(assembly):
    count, components, of_value = dict.fromkeys(FIGURES, 0), {}, {}
    for result, word, rest in re.findall(r"(%\w+) = Op(\w+) ?(.*)", assembly):
        words = rest.split()
        if word.startswith("Type"):
            components[result] = int(words[1]) if word == "TypeVector" else 1
            continue
        if not words or words[0] not in components:
            continue
        size = of_value[result] = components[words[0]]
        operands = words[3:] if word == "ExtInst" else words[1:]
        word = words[2] if word == "ExtInst" else word
        if word.startswith("ImageSample") or word == "ImageFetch":
            count["fetches"] += 1
        elif word == "FDiv":
            count["divisions"] += size
        elif word in SPECIAL:
            count["special functions"] += size
        elif word in ("Dot", "Length"):
            count["operations"] += 2 * of_value[operands[0]] - 1
            count["special functions"] += word == "Length"
        elif word in ONE or word in MORE or word.startswith(("FOrd", "FUnord")):
            count["operations"] += MORE.get(word, 1) * size
        elif word not in FREE:
            sys.exit(f"the instruction {word} is in no list")
    return tuple(count.values())


def main():
    if not shutil.which("spirv-opt") or not shutil.which("glslangValidator"):
        print("SKIPPED: spirv-opt or glslangValidator is missing (Debian's spirv-tools, glslang-tools)")
        sys.exit(77)
    folder = pathlib.Path(sys.argv[1])
    groups, printed, failures = {}, {}, 0
    for file in sorted(folder.glob("glsl/*.glsl")):
        text = file.read_text()
        said = re.match(r"(?://.*\n)*?// Cost: at most " + SAID.pattern, text)
        called = re.search(r"^\w+ baked_\w+\([^)]*\) \{(.*?)^\}", text, re.M | re.S).group(1)
        published = frozenset(re.sub("_of_4$", "", word) for word in re.findall(r"(\w+)\(", called))
        group = groups.setdefault(published - {"vec2", "vec3", "vec4", "float"}, [set(), set(), []])
        printed[file.stem] = tuple(map(int, said.groups()))
        group[0].add(printed[file.stem])
        group[1].add(cost(optimised(text)))
        group[2].append(file.stem)
    for published, (says, counted, files) in groups.items():
        most = tuple(map(max, zip(*counted)))
        failures += says != {most}
        print(*sorted(published), most, *(f"but it says {one}" for one in says if one != most), f"({len(files)} files)")
    for manifest in sorted(folder.glob("*/manifest.json")):
        prefix = "" if manifest.parent.name == "colours" else manifest.parent.name + "_"
        for asset in json.loads(manifest.read_text())["assets"]:
            said = printed[re.sub(r"\W", "_", prefix + asset["files"][0]["path"])]
            stated = tuple(asset["lookup_cost"][figure.replace(" ", "_")] for figure in FIGURES)
            failures += stated != said
            if stated != said:
                print(f"{manifest.parent.name}: {asset['name']} says {stated}, printed as {said}")
    if failures or len(groups) < 30:
        sys.exit(f"{len(groups)} groups, {failures} say what is wrong")


main()
