"""Puts $FILE$ into a folder that CalcMySky made for Stellarium: python3 $NAME$.stellarium.py FOLDER SET [SCATTERER].

SET counts groups of four wavelengths from 0, and SCATTERER is the name in params.atmo: that of the molecules for the
table `scattering`, whose higher orders come with them, and that of the aerosols for `single_mie`. The folder holds
CalcMySky's shaders for the same planet, the same wavelengths, in their order, and textures of these sizes.
"""

import shutil
import struct
import sys
from pathlib import Path

DIRECTIVES = ("all textures are radiances", "no eclipsed double scattering textures")


def place(folder, number, scatterer):
$if MAPPING=bruneton_transmittance$    return folder / f"transmittance-wlset{number}.f32"
$if MAPPING=bruneton_irradiance$    return folder / f"irradiance-wlset{number}.f32"
$if MAPPING=bruneton_scattering$    return folder / "single-scattering" / str(number) / f"{scatterer}.f32"


def main():
    folder, number, *rest = sys.argv[1:]
    folder, file = Path(folder), Path(__file__).with_name("$FILE$")
    to = place(folder, int(number), *(rest or [""]))
    to.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(file, to)
$if MAPPING=bruneton_scattering$    # The scatterers have all orders: there is nothing else to add.
$if MAPPING=bruneton_scattering$    sizes = file.read_bytes()[:8]
$if MAPPING=bruneton_scattering$    u, v, w, z = struct.unpack("<4H", sizes)
$if MAPPING=bruneton_scattering$    (folder / f"multiple-scattering-wlset{number}.f32").write_bytes(sizes + bytes(16 * u * v * w * z))
    parameters = folder / "params.atmo"
    lines = parameters.read_text().splitlines() if parameters.exists() else []
    parameters.write_text("\n".join(lines + [line for line in DIRECTIVES if line not in lines]) + "\n")
    print(to)


main()
