"""Checks the OpenAPI document: it is valid, a client generated from it has every operation, and works.

    python tests/openapi/check.py target/release/mist

needs the packages of requirements.txt.
"""

import contextlib
import importlib
import json
import pathlib
import subprocess
import sys
import tempfile

import openapi_spec_validator

GLASS = {"model": "Facet_BRDF_Model", "parameters": {"substrate": "(1.5,0)", "sdf.s": "0.3"}}
COLOR = {"wavelengths": [400, 500, 600, 700], "values": [1, 1, 1, 1], "illuminant": "D65"}


@contextlib.contextmanager
def service(mist):
    """The address of a service on loopback."""
    command = [mist, "serve", "--listen", "127.0.0.1:0"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        for line in process.stderr:
            if "listening on " in line:
                yield line.split("listening on ")[1].strip()
                return
        sys.exit("the service does not listen")
    finally:
        process.kill()
        process.wait()


def generated(document, folder):
    """The package of a client that is generated from `document`."""
    path = folder / "openapi.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    tool = pathlib.Path(sys.executable).parent / "openapi-python-client"
    arguments = ["generate", "--path", path, "--output-path", folder / "generated", "--meta", "none"]
    subprocess.run([tool, *arguments], check=True, stdout=subprocess.DEVNULL)
    sys.path.insert(0, str(folder))
    return importlib.import_module("generated")


def main(mist):
    document = json.loads(subprocess.check_output([mist, "serve", "--openapi"]))
    openapi_spec_validator.validate(document)
    operations = [each for path in document["paths"].values() for each in path.values()]
    with tempfile.TemporaryDirectory() as folder, service(mist) as url:
        client = generated(document, pathlib.Path(folder)).Client(base_url=url)
        modules = {
            each["operationId"]: importlib.import_module(f"generated.api.{each['tags'][0]}.{each['operationId']}")
            for each in operations
        }
        models = importlib.import_module("generated.models")

        def call(operation, status, *arguments, **named):
            answer = modules[operation].sync_detailed(*arguments, client=client, **named)
            assert answer.status_code == status, (operation, answer)
            return answer

        body = models.ModelBody.from_dict(GLASS)
        call("healthz", 200)
        call("list_models", 200)
        call("color", 200, body=COLOR)
        call("put_material", 201, "glass", body=body)
        call("put_material", 200, "glass", body=body)
        call("material_table", 200, "glass", "table.json", thetai="0:30:60", thetas="0", phis="0")
        call("get_job", 404, "none")
        call("delete_material", 204, "glass")
    print(f"openapi: valid, {len(modules)} operations of a generated client, one of each kind called")


if __name__ == "__main__":
    main(sys.argv[1])
