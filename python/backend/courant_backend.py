"""Builds the wheel with CMake, by nothing but Python itself (PEP 517).

The wheel has no parts under the GPL: COURANT_WITH_SUITESPARSE is OFF unless COURANT_CMAKE_ARGS says otherwise.
"""

import base64
import csv
import hashlib
import io
import os
import re
import shlex
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def _version():
    for folder, _, names in os.walk(os.path.join(ROOT, "core")):
        if "version.hpp" in names:
            with open(os.path.join(folder, "version.hpp"), encoding="utf-8") as file:
                return re.search(r'COURANT_VERSION_STRING "([^"]+)"', file.read()).group(1)
    raise RuntimeError("core has no version.hpp")


def _metadata():
    with open(os.path.join(ROOT, "python", "README.md"), encoding="utf-8") as file:
        description = file.read()
    return (f"Metadata-Version: 2.1\nName: courant\nVersion: {_version()}\n"
            "Summary: Geometric integrators from Dirac structures and the constraint algorithm\n"
            "License: BSD-3-Clause\nLicense-File: LICENSE\nRequires-Python: >=3.11\nRequires-Dist: numpy>=1.24\n"
            "Provides-Extra: plots\nRequires-Dist: matplotlib; extra == 'plots'\n"
            "Provides-Extra: tables\nRequires-Dist: pandas; extra == 'tables'\n"
            "Description-Content-Type: text/markdown\n\n" + description)


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{python}-{python}-{platform}"


def _installed(prefix):
    build = os.environ.get("COURANT_BUILD_DIR") or tempfile.mkdtemp(prefix="courant-build-")
    options = ["-D", "COURANT_BUILD_PYTHON=ON", "-D", "COURANT_BUILD_TESTS=OFF", "-D", "COURANT_BUILD_BENCH=OFF",
               "-D", "COURANT_UNITY=ON", "-D", "COURANT_WITH_SUITESPARSE=OFF",
               "-D", "COURANT_WITH_ARB=OFF", "-D", f"Python3_EXECUTABLE={sys.executable}"]
    options += shlex.split(os.environ.get("COURANT_CMAKE_ARGS", ""))
    subprocess.run(["cmake", "-S", ROOT, "-B", build, *options], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "courant_python", "--parallel", str(os.cpu_count())], check=True)
    subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", prefix, "--strip"], check=True)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The wheel; its name."""
    with tempfile.TemporaryDirectory() as prefix:
        _installed(prefix)
        files = {}
        for folder, _, names in os.walk(prefix):
            for name in names:
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    files[os.path.relpath(path, prefix).replace(os.sep, "/")] = file.read()
    info = f"courant-{_version()}.dist-info"
    files[f"{info}/METADATA"] = _metadata().encode()
    with open(os.path.join(ROOT, "LICENSE"), "rb") as file:
        files[f"{info}/LICENSE"] = file.read()
    files[f"{info}/WHEEL"] = ("Wheel-Version: 1.0\nGenerator: courant_backend\nRoot-Is-Purelib: false\n"
                              f"Tag: {_tag()}\n").encode()
    record = io.StringIO()
    rows = csv.writer(record, lineterminator="\n")
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        rows.writerow([name, f"sha256={digest}", len(content)])
    rows.writerow([f"{info}/RECORD", "", ""])
    files[f"{info}/RECORD"] = record.getvalue().encode()
    wheel = f"courant-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """The sources that git knows, as a tar; its name."""
    name = f"courant-{_version()}"
    path = os.path.join(sdist_directory, name + ".tar.gz")
    subprocess.run(["git", "-C", ROOT, "archive", f"--prefix={name}/", "-o", path, "HEAD"], check=True)
    return name + ".tar.gz"
