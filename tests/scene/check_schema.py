# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""The JSON Schema and the reader agree: on every shipped scene, and on good and bad changes of one.

check_schema.py SCENES_FOLDER READ_SCENES
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

REMOVED = object()
AIR = "atmosphere constituents 0 "
AEROSOL = "atmosphere constituents 1"
MIE = {"refractive_index": 1.5, "absorption_index": 0.01,
       "size": {"log_normal": {"effective_radius_m": 1e-6, "effective_variance": 0.1}},
       "optical_depth": {"at_nm": 550, "value": 0.1}}
MIE_CONSTITUENT = {"profile": "uniform", "mie": MIE}

# Where (keys and indices of the sample), what to put there, whether that is a scene.
CHANGES = [
    ("", {}, False), ("", [], False),
    ("surface noise", {}, True), ("surface", {"noise": {"seed": 5}}, True), ("surface", {}, False),
    ("surface noise", {"seed": 1.5}, False), ("surface noise", {"seed": -1}, False),
    ("surface noise", {"octaves": 41}, False), ("surface noise", {"form": "flat"}, False),
    ("surface noise", {"form": "ridged", "ocean_share": 0.5, "hurst": 0.8, "lacunarity": 2.1}, True),
    ("surface noise", {"height_m": 0}, False), ("surface noise", {"gain": 1}, False),
    ("surface biomes", [], True), ("surface biomes", [{"name": "x"}], False),
    ("surface biomes", [{"albedo": 0.3, "slope_deg": {"from": 30, "feather": 5}}], True),
    ("surface biomes", [{"albedo": [[500, 0.3]], "latitude_deg": {"to": 91}}], False),
    ("surface biomes", [{"albedo": 0.3, "moisture": {"feather": 0}}], False),
    ("surface biomes", [{"albedo": 1.3}], False), ("surface biomes", [{"albedo": 0.3}] * 17, False),
    ("surface climate", {"equator_C": 40, "pole_C": -60, "lapse_C_per_km": 5}, True),
    ("surface climate", {"lapse_C_per_km": -1}, False),
    ("clouds", {}, False), ("clouds", {"layers": []}, True), ("clouds", {"layers": [{}]}, True),
    ("clouds", {"layers": [{"type": "smog"}]}, False), ("clouds", {"layers": [{"type": "fog"}]}, True),
    ("clouds", {"layers": [{"belt": {"south_deg": 10, "feather_deg": 5}, "shear_m": 900, "cyclone_cover": 1}],
                "cyclones": [{"latitude_deg": -20, "radius_m": 4e5}]}, True),
    ("clouds", {"layers": [{"belt": {"west_deg": 10}}]}, False), ("clouds", {"layers": [], "cyclones": {}}, False),
    ("clouds", {"layers": [], "cyclones": [{"eye_radius_m": 1}]}, False),
    ("clouds", {"layers": [{}], "wind": 1}, False), ("clouds", {"layers": [{}], "systems_m": -1}, False),
    ("clouds", {"layers": [{}], "systems_m": 1e6}, True),
    ("clouds", {"layers": [{"type": "cirrus", "base_m": 9000, "top_m": 9900, "cover": 0.3,
                            "extinction_per_m": 0.001, "scale_m": 50000}], "seed": 7}, True),
    ("clouds", {"layers": [{"cover": 1.1}]}, False), ("clouds", {"layers": [{"base_m": -1}]}, False),
    ("clouds", {"layers": [{"extinction_per_m": 0}]}, False), ("clouds", {"layers": [{"scale_m": 9}]}, False),
    ("clouds", {"layers": [{}] * 5}, False), ("clouds", {"layers": [], "seed": 0.5}, False),
    ("clouds", {"layers": [], "map": "/vsicurl/x"}, False), ("clouds", {"layers": [], "map": "x.tif"}, True),
    ("terrella", 2, False), ("terrella", REMOVED, False), ("terrella", True, False),
    ("name", REMOVED, True), ("name", "", False), ("name", 3, False),
    ("nmae", "x", False), ("comment", "x", True), ("comment", 1, False), ("$schema", "x", True),
    ("star", REMOVED, False), ("star spectral_irradiance", REMOVED, False),
    ("star spectral_irradiance", -1, False), ("star angular_radius_deg", REMOVED, True),
    ("star angular_radius_deg", 91, False), ("star corona", 1, True), ("star corona", -1, False),
    ("star comment", "x", True),
    ("planet", REMOVED, False), ("planet radius_m", 0, False), ("planet radius_m", 1e10, False),
    ("planet radius_m", "9", False), ("planet radius_m", None, False),
    ("planet ground_albedo", 1.5, False), ("planet ground_albedo", REMOVED, False),
    ("planet ground_albedo", [[500, 0.5]], True), ("planet ground_albedo", [[500, 1.5]], False),
    ("atmosphere", REMOVED, True), ("atmosphere height_m", REMOVED, False),
    ("atmosphere height_m", 0, False), ("atmosphere constituents", [], True),
    ("atmosphere constituents", REMOVED, False), ("atmosphere constituents", {}, False),
    (AIR + "name", REMOVED, True), (AIR + "profile", REMOVED, False),
    (AIR + "phase", REMOVED, False), (AIR + "scattering_per_m", REMOVED, True),
    (AIR + "absorption_per_m", REMOVED, True), (AIR + "density", 1, False),
    (AIR + "scattering_per_m", 1001, False), (AIR + "scattering_per_m", -1, False),
    (AIR + "scattering_per_m", True, False), (AIR + "scattering_per_m", "1", False),
    (AIR + "scattering_per_m", [], False), (AIR + "scattering_per_m", [[1, 2, 3]], False),
    (AIR + "scattering_per_m", [[1, 0.2], [2, 0.3]], True),
    (AIR + "scattering_per_m", [[0, 0.2]], False), (AIR + "scattering_per_m", [1, 2], False),
    (AIR + "scattering_per_m", {}, False), (AIR + "scattering_per_m", {"comment": "x"}, False),
    (AIR + "scattering_per_m", {"file": ""}, False),
    (AIR + "scattering_per_m", {"file": "/vsicurl/x"}, False),
    (AIR + "scattering_per_m", {"file": "http://x"}, False),
    (AIR + "scattering_per_m", {"power_law": {"at_nm": 550, "value": 1e-5, "exponent": -1}}, True),
    (AIR + "scattering_per_m", {"power_law": {"at_nm": 550, "value": 1e-5}}, False),
    (AIR + "scattering_per_m", {"power_law": {"at_nm": 0, "value": 1e-5, "exponent": 1}}, False),
    (AIR + "scattering_per_m",
     {"rayleigh": {"refractive_index": 1.00027, "number_density_per_m3": 2.5e25}}, True),
    (AIR + "scattering_per_m",
     {"rayleigh": {"refractive_index": 0.9, "number_density_per_m3": 2.5e25}}, False),
    (AIR + "scattering_per_m",
     {"rayleigh": {"refractive_index": 1.1, "number_density_per_m3": 0}}, False),
    (AIR + "scattering_per_m", {"blackbody": {"temperature_K": 5778, "total_W_m2": 0}}, True),
    (AIR + "scattering_per_m", {"blackbody": {"temperature_K": 0, "total_W_m2": 0}}, False),
    (AIR + "scattering_per_m", {"blackbody": {"temperature_K": 9}}, False),
    (AIR + "profile", "uniform", True), (AIR + "profile", "even", False), (AIR + "profile", 1, False),
    (AIR + "profile", {}, False), (AIR + "profile", {"exponential": {}}, False),
    (AIR + "profile", {"exponential": {"scale_height_m": -8}}, False),
    (AIR + "profile", {"tent": {"centre_m": 25000, "half_width_m": 15000}}, True),
    (AIR + "profile", {"tent": {"centre_m": 25000, "half_width_m": 0}}, False),
    (AIR + "profile", {"tent": {"half_width_m": 1}}, False),
    (AIR + "profile", {"table": [[0, 1], [1000, 0]]}, True), (AIR + "profile", {"table": []}, False),
    (AIR + "profile", {"table": [[0, -1]]}, False),
    (AIR + "profile", {"table": [[0, 1]], "exponential": {"scale_height_m": 1}}, False),
    (AIR + "phase", "isotropic", True), (AIR + "phase", "mie", False), (AIR + "phase", {}, False),
    (AIR + "phase", {"henyey_greenstein": {"g": 0.76}}, True),
    (AIR + "phase", {"henyey_greenstein": {"g": 1}}, False),
    (AIR + "phase", {"henyey_greenstein": {}}, False),
    (AIR + "phase", {"cornette_shanks": {"g": -0.5, "comment": "x"}}, True),
    (AIR + "phase", {"cornette_shanks": {"g": "0"}}, False),
    (AIR + "phase", {"table": [[0, 2], [180, 1]]}, True),
    (AIR + "phase", {"table": [[0, 2], [181, 1]]}, False),
    (AIR + "phase", {"table": [[0, -2]]}, False), (AIR + "phase", {"table": "x"}, False),
    (AIR + "phase", {"by_wavelength": [[450, "rayleigh"], [550, "isotropic"]]}, True),
    (AIR + "phase", {"by_wavelength": [[450, {"henyey_greenstein": {"g": 0.5}}]], "comment": "x"}, True),
    (AIR + "phase", {"by_wavelength": []}, False), (AIR + "phase", {"by_wavelength": {}}, False),
    (AIR + "phase", {"by_wavelength": [[450]]}, False), (AIR + "phase", {"by_wavelength": [450]}, False),
    (AIR + "phase", {"by_wavelength": [[0, "rayleigh"]]}, False),
    (AIR + "phase", {"by_wavelength": [[450, {"by_wavelength": []}]]}, False),
    (AIR + "phase", {"by_wavelength": [[450, "rayleigh"]], "table": [[0, 1]]}, False),
    (AIR + "mie", MIE, False), (AEROSOL, MIE_CONSTITUENT, True),
    (AEROSOL + " mie number_density_per_m3", 1e8, False),
    (AEROSOL + " mie optical_depth", REMOVED, False), (AEROSOL + " mie optical_depth at_nm", 100, False),
    (AEROSOL + " mie optical_depth value", -1, False), (AEROSOL + " mie size", {}, False),
    (AEROSOL + " mie size", {"gamma": {"effective_radius_m": 1e-6, "effective_variance": 0.1}}, True),
    (AEROSOL + " mie size", {"gamma": {"effective_radius_m": 1e-6, "effective_variance": 0.5}}, False),
    (AEROSOL + " mie size log_normal effective_variance", 0, False),
    (AEROSOL + " mie size log_normal effective_radius_m", REMOVED, False),
    (AEROSOL + " mie refractive_index", [[400, 1.5], [700, 1.4]], True),
    (AEROSOL + " mie refractive_index", REMOVED, False), (AEROSOL + " mie refractive_index", 0, False),
    (AEROSOL + " mie absorption_index", REMOVED, True), (AEROSOL + " mie absorption_index", -1, False),
    (AEROSOL + " mie phase_at_nm", [], False), (AEROSOL + " mie phase_at_nm", [450, 550], True),
    (AEROSOL + " mie phase_at_nm", 450, False), (AEROSOL + " mie radius", 1, False),
    (AEROSOL + " profile", REMOVED, False), (AEROSOL + " phase", "rayleigh", False),
    ("surface", REMOVED, True), ("surface", {}, False), ("surface layers", [], True),
    ("surface layers 0 elevation", "https://x.org/a.tif", True), ("surface layers 0 elevation", "http://x/a", True),
    ("surface layers 0 elevation", "s3://b/a.tif", True), ("surface layers 0 elevation", "/vsigs/b/a.tif", True),
    ("surface layers 0 elevation", "ftp://x/a.tif", False), ("surface layers 0 elevation", "/vsimem/a.tif", False),
    ("surface layers 0 elevation", "/vsicurl_streaming/http://x/a.tif", False),
    ("surface layers 0 elevation", "/vsizip/x", False), ("surface layers 0 elevation", 5, False),
    ("surface layers 0 scale", 2, True), ("surface layers 0 scale", "2", False),
    ("surface layers 0 optional", 1, False), ("surface layers 0 optional", True, True),
    ("surface layers 0 feather_deg", -1, False), ("surface layers 0 radiance_cd_m2", 1, False),
    ("surface layers 0", {}, False), ("surface layers 0", {"water": "w", "colour": "c"}, False),
    ("surface layers 0", {"lights": "l", "radiance_cd_m2": 2, "name": "n"}, True),
    ("surface layers 0", {"colour": "c", "scale": 2}, False),
    ("surface layers 0 blend", "add", True), ("surface layers 0 blend", "mix", False),
    ("surface layers 0 blend", 1, False), ("surface layers 0", {"normal": "n"}, True),
    ("surface layers 0", {"normal": "n", "blend": "add"}, True),
    ("surface layers 0", {"normal": "n", "blend": "max"}, False),
    ("surface layers 0", {"snow": "s", "albedo": 0.8}, True), ("surface layers 0", {"snow": "s"}, True),
    ("surface layers 0", {"snow": "s", "albedo": 1.1}, False),
    ("surface layers 0", {"snow": "s", "blend": "max"}, False),
    ("surface layers 0", {"colour": "c", "albedo": 0.5}, False),
    ("surface exaggeration", 3, True), ("surface exaggeration", 0, False),
    ("surface exaggeration", 1001, False),
    ("rayleigh", {}, True), ("rayleigh", 5, False), ("rayleigh", {"comment": "x", "samples": 13}, True),
    ("rayleigh", {"samples": 4}, False), ("rayleigh", {"samples": 67}, False),
    ("rayleigh", {"wavelengths": 2}, False), ("rayleigh", {"wavelengths": 3.5}, False),
    ("rayleigh", {"wavelengths": 20, "optical_depth": "fit", "fit_heights": 4, "fit_degree": 3}, True),
    ("rayleigh", {"optical_depth": "map"}, False), ("rayleigh", {"fit_degree": 8}, False),
    ("rayleigh", {"fit_heights": 1}, False), ("rayleigh", {"out_scattering": 0}, False),
    ("rayleigh", {"out_scattering": False, "height_scale": 15, "star_temperature_K": 5778}, True),
    ("rayleigh", {"height_scale": 0}, False), ("rayleigh", {"star_temperature_K": 0}, False),
    ("rayleigh", {"sample": 5}, False),
    ("planet gravity_m_s2", 3.7, True), ("planet gravity_m_s2", 0, False),
    ("ocean", {}, True), ("ocean", [], False), ("ocean", {"wave": {}}, False),
    ("ocean", {"waves": {}, "water": {}, "bed": {}, "comment": "x"}, True),
    ("ocean", {"waves": {"wind_m_s": 0, "wind_from_deg": -90, "fetch_km": 10, "count": 1000, "seed": 3,
                         "spectrum": "pierson_moskowitz", "whitecaps": 0, "mean_square_slope": 0}}, True),
    ("ocean", {"waves": {"wind_m_s": 61}}, False), ("ocean", {"waves": {"wind_from_deg": 361}}, False),
    ("ocean", {"waves": {"fetch_km": 0}}, False), ("ocean", {"waves": {"count": 0}}, False),
    ("ocean", {"waves": {"count": 2.5}}, False), ("ocean", {"waves": {"count": 1001}}, False),
    ("ocean", {"waves": {"seed": 0.5}}, False), ("ocean", {"waves": {"spectrum": "flat"}}, False),
    ("ocean", {"waves": {"mean_square_slope": 0.6}}, False), ("ocean", {"waves": {"whitecaps": -1}}, False),
    ("ocean", {"water": {"kind": "fresh", "chlorophyll_mg_m3": 1, "mud_g_m3": 5,
                         "dissolved_per_m_440": 0.1}}, True),
    ("ocean", {"water": {"absorption_per_m": [[450, 0.01], [650, 0.3]], "scattering_per_m": 0.001,
                         "refractive_index": 1.29}}, True),
    ("ocean", {"water": {"refractive_index": 1}}, False), ("ocean", {"water": {"kind": "milk"}}, False),
    ("ocean", {"water": {"refractive_index": [[500, 5]]}}, False),
    ("ocean", {"water": {"absorption_per_m": -1}}, False), ("ocean", {"water": {"mud_g_m3": -1}}, False),
    ("ocean", {"water": {"chlorophyll_mg_m3": "1"}}, False), ("ocean", {"water": {"salt": 1}}, False),
    ("ocean", {"bed": {"depth_m": 0, "albedo": [[500, 0.3]]}}, True),
    ("ocean", {"bed": {"depth_m": -1}}, False), ("ocean", {"bed": {"albedo": 1.1}}, False),
    ("ocean", {"bed": 5}, False),
    ("views", REMOVED, True), ("views", {}, True), ("views", [], False), ("views comment", "x", True),
    ("views comment", 7, False),
    ("views one", {}, False), ("views one camera", REMOVED, False), ("views one sun", REMOVED, False),
    ("views one camera latitude_deg", 91, False), ("views one camera longitude_deg", REMOVED, False),
    ("views one camera altitude_m", REMOVED, False),
    ("views one camera height_above_ground_m", 5, False),
    ("views one camera height_above_waves_m", 5, False),
    ("views one camera", {"latitude_deg": 1, "longitude_deg": 2, "height_above_waves_m": 5}, True),
    ("views one camera roll_deg", 5, True),
    ("views one camera vertical_fov_deg", 180, False), ("views one camera zoom", 2, False),
    ("views one sun", {"subsolar_latitude_deg": 1, "subsolar_longitude_deg": 2}, True),
    ("views one sun", {"subsolar_latitude_deg": 1, "azimuth_deg": 2}, False),
    ("views one sun", {}, False), ("views one sun elevation_deg", -91, False),
    ("stars", {}, True), ("stars", 5, False), ("stars", {"catalogue": "s.csv", "optional": True}, True),
    ("stars", {"catalogue": "http://x"}, False), ("stars", {"catalogue": 3}, False),
    ("stars", {"limit_magnitude": 31}, False), ("stars", {"background_cd_m2": 2e-4}, True),
    ("stars", {"airglow_share": 0.6}, True), ("stars", {"airglow_share": 1.1}, False),
    ("stars", {"background_cd_m2": -1}, False), ("stars", {"pole": {"declination_deg": 90}}, False),
    ("stars", {"pole": {"right_ascension_deg": 317.7, "declination_deg": 52.9}}, True),
    ("stars", {"color": 1}, False), ("views one sidereal_deg", 90, True),
    ("views one time_s", 86400.5, True), ("views one time_s", "noon", False), ("views one time_s", 1e13, False),
    ("views one sidereal_deg", 361, False), ("bodies", {}, False),
    ("bodies 0 name", REMOVED, False), ("bodies 0 name", "comment", False),
    ("bodies 0 name", "x" * 65, False), ("bodies 0 radius_m", 0, False),
    ("bodies 0 radius_m", REMOVED, False), ("bodies 0 distance_m", REMOVED, False),
    ("bodies 0 geometric_albedo", [[500, 0.1]], True), ("bodies 0 geometric_albedo", 2.1, False),
    ("bodies 0 geometric_albedo", REMOVED, False), ("bodies 0 mass_kg", 1, False),
    ("bodies 0 phase_law", "lunar", True), ("bodies 0 phase_law", "moon", False),
    ("views one bodies", REMOVED, True), ("views one bodies", {}, True),
    ("views one bodies comment", "x", True), ("views one bodies", [], False),
    ("views one bodies Moon", {}, False), ("views one bodies Moon", 3, False),
    ("views one bodies Moon", {"latitude_deg": 1, "longitude_deg": 2, "distance_m": 4e8}, True),
    ("views one bodies Moon", {"latitude_deg": 1, "azimuth_deg": 2}, False),
    ("views one bodies Moon", {"latitude_deg": 1}, False),
    ("views one bodies Moon", {"offset_from_sun_deg": [0.1, -0.2]}, True),
    ("views one bodies Moon", {"offset_from_sun_deg": [0.1]}, False),
    ("views one bodies Moon", {"offset_from_sun_deg": [0.1, 181]}, False),
    ("views one bodies Moon", {"offset_from_sun_deg": 0.1}, False),
    ("views one bodies Moon", {"offset_from_sun_deg": [0, 0], "latitude_deg": 1}, False),
    ("views one bodies Moon elevation_deg", 91, False), ("views one bodies Moon phase", 1, False),
    ("views one exposure", {}, True), ("views one exposure", {"tone": "filmic", "ev100": 15}, True),
    ("views one exposure", {"tone": "warm"}, False), ("views one exposure", {"bias_ev": 41}, False),
]

SAMPLE = {
    "terrella": 1,
    "name": "Test",
    "star": {"spectral_irradiance": 1.5, "angular_radius_deg": 0.25},
    "planet": {"radius_m": 6371000, "ground_albedo": 0.1},
    "atmosphere": {"height_m": 100000, "constituents": [{
        "name": "air", "scattering_per_m": 1e-5, "absorption_per_m": 0,
        "profile": {"exponential": {"scale_height_m": 8000}}, "phase": "rayleigh"}, MIE_CONSTITUENT]},
    "surface": {"layers": [{"elevation": "a.tif"}]},
    "bodies": [{"name": "Moon", "radius_m": 1737400, "distance_m": 384400000,
                "geometric_albedo": 0.12}],
    "views": {"one": {
        "camera": {"latitude_deg": 10, "longitude_deg": 20, "altitude_m": 3},
        "sun": {"elevation_deg": 45, "azimuth_deg": 180},
        "bodies": {"Moon": {"elevation_deg": 20, "azimuth_deg": 90}}}},
}


def change(path, value):
    """The sample with one value put in or taken out."""
    scene = copy.deepcopy(SAMPLE)
    keys = [int(key) if key.isdigit() else key for key in path.split()]
    if not keys:
        return value
    place = scene
    for key in keys[:-1]:
        place = place[key]
    if value is REMOVED:
        del place[keys[-1]]
    else:
        place[keys[-1]] = value
    return scene


def read(reader, files):
    """What the reader says of each file."""
    run = subprocess.run([reader, *files], stdout=subprocess.PIPE, check=True)
    lines = run.stdout.decode().splitlines()
    if len(lines) != len(files):
        sys.exit(f"{len(lines)} lines from the reader for {len(files)} files")
    return lines


def check_shipped(validator, scenes, reader):
    """Shipped scenes are scenes to both. Returns the number of faults."""
    files = sorted(p for p in scenes.rglob("*.json") if not p.name.endswith(".schema.json"))
    if not files:
        sys.exit(f"no scenes in {scenes}")
    faults = 0
    for file, said in zip(files, read(reader, files)):
        errors = [e.message for e in validator.iter_errors(json.loads(file.read_text()))]
        if errors or said != "ok":
            print(f"{file.name}: schema: {errors}; reader: {said}")
            faults += 1
    return faults


def check_same_air(scenes):
    """The bare sphere stands for Earth in benches: the same star and air. Returns the number of faults."""
    earth, bare = (json.loads((scenes / name).read_text()) for name in ("earth.json", "bare-sphere.json"))
    differing = [key for key in ("star", "atmosphere") if earth[key] != bare[key]]
    if differing:
        print(f"earth.json and bare-sphere.json differ in {differing}")
    return len(differing)


def check_changes(validator, reader):
    """Both say of every change what is expected. Returns the number of faults."""
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, (path, value, _) in enumerate(CHANGES):
            files.append(pathlib.Path(folder) / f"{number}.json")
            files[-1].write_text(json.dumps(change(path, value)))
        for (path, value, is_good), said in zip(CHANGES, read(reader, files)):
            by_schema = validator.is_valid(change(path, value))
            if by_schema != is_good or (said == "ok") != is_good:
                shown = "removed" if value is REMOVED else json.dumps(value)
                print(f"{path or 'root'} = {shown}: expected {is_good}, "
                      f"schema {by_schema}, reader: {said}")
                faults += 1
    return faults


def main():
    scenes, reader = pathlib.Path(sys.argv[1]), sys.argv[2]
    schema = json.loads((scenes / "terrella.schema.json").read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    if not validator.is_valid(SAMPLE):
        sys.exit("the sample itself is not valid")
    faults = check_shipped(validator, scenes, reader) + check_same_air(scenes)
    faults += check_changes(validator, reader)
    print(f"{len(CHANGES)} changes, {faults} faults")
    sys.exit(1 if faults else 0)


main()
