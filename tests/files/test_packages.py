"""Tests of how ROS packages and URIs are found."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from yamaro.files import packages
from yamaro.files.packages import PackageFinder, is_package_name, manifest_name


def make_package(folder: Path, name: str | None = None) -> str:
    folder.mkdir(parents=True, exist_ok=True)
    manifest = (
        f"<?xml version='1.0'?>\n<package format='3'>\n  <name>{name or folder.name}</name>\n"
    )
    (folder / "package.xml").write_text(manifest + "</package>\n")
    return str(folder)


def install_package(prefix: Path, name: str) -> str:
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True, exist_ok=True)
    (index / name).write_text("")
    share = prefix / "share" / name
    share.mkdir(parents=True)
    return str(share)


def test_ament_index_comes_before_ros_package_path_and_the_workspace(tmp_path: Path) -> None:
    installed = install_package(tmp_path / "opt", "arm")
    crawled = make_package(tmp_path / "ros1" / "deep" / "arm")
    local = make_package(tmp_path / "ws" / "src" / "arm")
    start = os.path.join(local, "urdf")
    ament = {"AMENT_PREFIX_PATH": str(tmp_path / "opt")}
    ros1 = {"ROS_PACKAGE_PATH": str(tmp_path / "ros1")}
    assert PackageFinder({**ament, **ros1}).find("arm", start) == installed
    assert PackageFinder(ros1).find("arm", start) == crawled
    assert PackageFinder({}).find("arm", start) == local


def test_the_first_prefix_wins_and_a_marker_without_share_folder_does_not_count(
    tmp_path: Path,
) -> None:
    install_package(tmp_path / "a", "arm")
    os.rmdir(tmp_path / "a" / "share" / "arm")
    second = install_package(tmp_path / "b", "arm")
    install_package(tmp_path / "c", "arm")
    paths = os.pathsep.join(str(tmp_path / name) for name in ("none", "a", "b", "c"))
    finder = PackageFinder({"AMENT_PREFIX_PATH": paths})
    assert finder.find("arm", str(tmp_path)) == second


def test_process_environment_is_the_default(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    share = install_package(tmp_path, "arm")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert PackageFinder().find("arm", "/") == share


def test_package_of_the_file_its_siblings_and_its_workspace_are_found_without_ros(
    tmp_path: Path,
) -> None:
    source = tmp_path / "ws" / "src"
    own = make_package(source / "repo" / "arm_description")
    sibling = make_package(source / "repo" / "arm_meshes")
    far = make_package(source / "third_party" / "grippers" / "gripper")
    make_package(source / "build" / "ghost")
    start = os.path.join(own, "urdf", "parts")
    finder = PackageFinder({})
    assert finder.find("arm_description", start) == own
    assert finder.find("arm_meshes", start) == sibling
    assert finder.find("gripper", start) == far
    assert finder.find("ghost", start) is None
    assert finder.names(start) == ["arm_description", "arm_meshes", "gripper"]


def test_packages_of_the_same_repository_are_found(tmp_path: Path) -> None:
    (tmp_path / ".git").mkdir()
    other = make_package(tmp_path / "ros" / "arm")
    (tmp_path / "robots").mkdir()
    assert PackageFinder({}).find("arm", str(tmp_path / "robots")) == other


def test_beside_a_package_only_its_siblings_are_searched(tmp_path: Path) -> None:
    own = make_package(tmp_path / "home" / "arm")
    sibling = make_package(tmp_path / "home" / "hand")
    make_package(tmp_path / "home" / "old" / "foot")
    finder = PackageFinder({})
    assert finder.find("hand", own) == sibling
    assert finder.find("foot", own) is None


def test_names_of_all_packages_are_told(tmp_path: Path) -> None:
    install_package(tmp_path / "opt", "gripper")
    make_package(tmp_path / "ros1" / "arm")
    own = make_package(tmp_path / "src" / "hand")
    prefixes = os.pathsep.join([str(tmp_path / "none"), str(tmp_path / "opt")])
    finder = PackageFinder(
        {"AMENT_PREFIX_PATH": prefixes, "ROS_PACKAGE_PATH": str(tmp_path / "ros1")}
    )
    assert finder.names(own) == ["arm", "gripper", "hand"]


def test_names_are_told_of_those_packages_only_that_are_found(tmp_path: Path) -> None:
    own = make_package(tmp_path / "ws" / "arm")
    make_package(tmp_path / "ws" / "other" / "hand")
    finder = PackageFinder({})
    assert finder.find("hand", own) is None
    assert finder.names(own) == ["arm"]


def test_a_bare_folder_is_not_searched(tmp_path: Path) -> None:
    make_package(tmp_path / "home" / "projects" / "arm")
    assert PackageFinder({}).find("arm", str(tmp_path / "home")) is None


def test_name_comes_from_the_manifest_not_the_folder(tmp_path: Path) -> None:
    folder = make_package(tmp_path / "checkout-1.2", name="arm")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)})
    assert finder.find("arm", "/") == folder
    assert finder.find("checkout-1.2", "/") is None


def test_package_path_may_name_the_package_itself(tmp_path: Path) -> None:
    folder = make_package(tmp_path / "arm")
    make_package(tmp_path / "arm" / "nested")
    finder = PackageFinder({"ROS_PACKAGE_PATH": folder})
    assert finder.find("arm", "/") == folder
    assert finder.find("nested", "/") is None


@pytest.mark.parametrize("marker", sorted(packages.IGNORE_MARKERS))
def test_ignored_folders_are_skipped(tmp_path: Path, marker: str) -> None:
    make_package(tmp_path / "old" / "arm")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)})
    assert finder.names("/") == ["arm"]
    (tmp_path / "old" / marker).write_text("")
    assert PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)}).names("/") == []


def test_an_ignored_folder_hides_no_other(tmp_path: Path) -> None:
    for name in ("a", "c"):
        make_package(tmp_path / name / "ignored")
        (tmp_path / name / "COLCON_IGNORE").write_text("")
    hand = make_package(tmp_path / "b" / "hand")
    assert PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)}).find("hand", "/") == hand


def test_of_two_packages_with_one_name_the_first_by_path_is_taken(tmp_path: Path) -> None:
    for folder in ("b", "a", "c"):
        make_package(tmp_path / folder, name="arm")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)})
    assert finder.find("arm", "/") == str(tmp_path / "a")


@pytest.mark.parametrize("is_reversed", [False, True])
def test_of_two_links_to_a_folder_the_first_by_name_counts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_reversed: bool
) -> None:
    """In whatever order the system lists them."""
    root = tmp_path / "ros"
    root.mkdir()
    make_package(tmp_path / "elsewhere" / "arm")
    for name in ("b", "a", "c"):
        (root / name).symlink_to(tmp_path / "elsewhere")
    real = os.scandir

    @contextmanager
    def in_order(folder: str) -> Iterator[list[os.DirEntry[str]]]:
        with real(folder) as entries:
            yield sorted(entries, key=lambda entry: entry.name, reverse=is_reversed)

    monkeypatch.setattr(os, "scandir", in_order)
    found = PackageFinder({"ROS_PACKAGE_PATH": str(root)}).find("arm", "/")
    assert found == str(root / "a" / "arm")


def test_linked_folders_are_followed_and_loops_end(tmp_path: Path) -> None:
    make_package(tmp_path / "elsewhere" / "arm")
    root = tmp_path / "src"
    root.mkdir()
    (root / "link").symlink_to(tmp_path / "elsewhere")
    (root / "loop").symlink_to(root)
    (root / "dangling").symlink_to(tmp_path / "nowhere")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(root)})
    assert finder.find("arm", "/") == str(root / "link" / "arm")


def test_several_links_are_followed(tmp_path: Path) -> None:
    root = tmp_path / "src"
    root.mkdir()
    for name in ("arm", "hand"):
        make_package(tmp_path / f"place_of_{name}" / name)
        (root / name).symlink_to(tmp_path / f"place_of_{name}")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(root)})
    assert [finder.find(name, "/") for name in ("arm", "hand")] == [
        str(root / "arm" / "arm"),
        str(root / "hand" / "hand"),
    ]


def test_search_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    deep = tmp_path.joinpath(*"abcdefghij", "arm")
    make_package(deep)
    for number in range(20):
        make_package(tmp_path / f"p{number:02}")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)})
    assert "arm" not in finder.names("/")
    monkeypatch.setattr(packages, "MAX_FOLDERS", 12)
    assert len(PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)}).names("/")) < 12


def test_answers_are_remembered_for_the_life_of_the_finder(tmp_path: Path) -> None:
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)})
    assert finder.find("arm", "/") is None
    folder = make_package(tmp_path / "arm")
    assert finder.find("arm", "/") is None
    assert PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)}).find("arm", "/") == folder


def test_a_folder_is_searched_once(tmp_path: Path) -> None:
    arm = make_package(tmp_path / "arm")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)})
    assert finder.find("arm", "/") == arm
    hand = make_package(tmp_path / "hand")
    assert finder.find("hand", "/") is None
    assert PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)}).find("hand", "/") == hand


def test_threads_may_share_a_finder(tmp_path: Path) -> None:
    for number in range(50):
        make_package(tmp_path / f"p{number}")
    finder = PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)})
    answers: list[str | None] = []

    def ask(number: int) -> None:
        answers.append(finder.find(f"p{number % 50}", "/"))

    threads = [threading.Thread(target=ask, args=(n,)) for n in range(100)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(map(str, answers)) == sorted(str(tmp_path / f"p{n % 50}") for n in range(100))


@pytest.mark.parametrize(
    ("manifest", "name"),
    [
        ("<package><name>arm</name></package>", "arm"),
        ("<package>\n <name>\n  arm\n </name>\n</package>", "arm"),
        ("<package><!-- <name>old</name> --><name>arm</name></package>", "arm"),
        ("<package><names>no</names><name >arm</name></package>", "arm"),
        ("<package><name\tid='x'>arm</name></package>", "arm"),
        ("<package><name\nid='x'>arm</name></package>", "arm"),
        ("<package><name\r\nid='x'>arm</name></package>", "arm"),
        ("<name>arm</name>", "arm"),
        ("<names/><name>arm</name>", "arm"),
        ("<!-- <name>old</name> --><name>arm</name>", "arm"),
        ("<!-- a --><name>arm</name><!-- b -->", "arm"),
        ("<!-- <!-- --><name>arm</name>", "arm"),
        ("\ufeff<package><name>arm</name></package>", "arm"),
        ("<package><name></name></package>", None),
        ("<package><name>arm", None),
        ("<package><!-- <name>arm</name>", None),
        ("<package/>", None),
        ("", None),
    ],
)
def test_names_in_manifests(tmp_path: Path, manifest: str, name: str | None) -> None:
    (tmp_path / "package.xml").write_text(manifest, encoding="utf-8")
    assert manifest_name(str(tmp_path)) == name


def test_a_manifest_in_another_encoding_is_read(tmp_path: Path) -> None:
    manifest = "<package><author>Zoë</author><name>arm</name></package>"
    (tmp_path / "package.xml").write_bytes(manifest.encode("latin-1"))
    assert manifest_name(str(tmp_path)) == "arm"


@pytest.mark.parametrize("name", ["", ".", "..", "../arm", "arm/urdf", "a b", "ärm", "arm\n"])
def test_odd_names_are_never_looked_up(tmp_path: Path, name: str) -> None:
    install_package(tmp_path / "arm", "arm")
    finder = PackageFinder({"AMENT_PREFIX_PATH": str(tmp_path / "arm")})
    assert not is_package_name(name)
    assert finder.find(name, "/") is None
    assert finder.looked_at(name, "/") == []
    assert finder.resolve_uri(f"model://{name.partition('/')[0]}#/x", "/") is None


@pytest.mark.parametrize("name", ["arm", "arm_2", "arm-description", "2arm"])
def test_usual_names_are_looked_up(name: str) -> None:
    assert is_package_name(name)


def test_packages_around_a_file_are_its_own_and_those_beside_it(tmp_path: Path) -> None:
    arm = make_package(tmp_path / "arm")
    hand = make_package(tmp_path / "hand")
    make_package(tmp_path / "more" / "deep")
    assert PackageFinder({}).around(os.path.join(arm, "urdf")) == [arm, arm, hand]


def test_a_folder_that_cannot_be_read_hides_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a").mkdir()
    hand = make_package(tmp_path / "b" / "hand")
    look = os.scandir

    def look_if_permitted(path: str) -> object:
        if path == str(tmp_path / "a"):
            raise PermissionError(path)
        return look(path)

    monkeypatch.setattr(os, "scandir", look_if_permitted)
    assert PackageFinder({"ROS_PACKAGE_PATH": str(tmp_path)}).find("hand", "/") == hand


@pytest.mark.skipif(os.name == "nt", reason="there, c: is a drive")
def test_a_colon_in_a_path_is_no_drive() -> None:
    assert PackageFinder({}).resolve_uri("file:///c:/x.stl", "/base") == "/c:/x.stl"
    assert PackageFinder({}).resolve_uri("file:///ab/x.stl", "/base") == "/ab/x.stl"


def test_only_the_innermost_package_and_workspace_count(tmp_path: Path) -> None:
    outer = tmp_path / "src" / "outer"
    make_package(outer)
    inner = make_package(outer / "src" / "group" / "inner")
    assert packages.surroundings(os.path.join(inner, "urdf")) == [
        (str(outer / "src" / "group"), 1),
        (str(outer / "src"), packages.MAX_DEPTH),
    ]


def test_places_looked_at_are_told(tmp_path: Path) -> None:
    own = make_package(tmp_path / "src" / "arm")
    finder = PackageFinder({"AMENT_PREFIX_PATH": "/opt/a" + os.pathsep + "/opt/b"})
    assert finder.looked_at("hand", own) == [
        "/opt/a (AMENT_PREFIX_PATH)",
        "/opt/b (AMENT_PREFIX_PATH)",
        "ROS_PACKAGE_PATH (not set)",
        f"{own} and the folders that contain it",
        f"{tmp_path / 'src'} and the folders below it",
    ]


def test_uris_resolve(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    share = install_package(tmp_path / "opt", "arm")
    model = tmp_path / "models" / "table"
    model.mkdir(parents=True)
    monkeypatch.setenv("HOME", str(tmp_path))
    finder = PackageFinder(
        {"AMENT_PREFIX_PATH": str(tmp_path / "opt"), "GAZEBO_MODEL_PATH": str(tmp_path / "models")}
    )
    base = str(tmp_path / "base")
    expected = {
        "package://arm/meshes/a.stl": f"{share}/meshes/a.stl",
        "PACKAGE://arm/a.stl": f"{share}/a.stl",
        "package://arm": share,
        "package://arm/a%20b.stl": f"{share}/a b.stl",
        "package://none/a.stl": None,
        "package:///a.stl": None,
        "model://table/table.dae": f"{model}/table.dae",
        "model://arm/a.stl": f"{share}/a.stl",
        "model://none/a.stl": None,
        "file:///tmp/a.stl": "/tmp/a.stl",
        "file://localhost/tmp/a.stl": "/tmp/a.stl",
        "file://meshes/a.stl": f"{base}/meshes/a.stl",
        "meshes/../a.stl": f"{base}/a.stl",
        "./a%20b.stl": f"{base}/a%20b.stl",
        "/tmp/a.stl": "/tmp/a.stl",
        "~/a.stl": f"{tmp_path}/a.stl",
        "https://example.org/a.stl": None,
    }
    assert {uri: finder.resolve_uri(uri, base) for uri in expected} == expected


def test_a_percent_sign_that_is_part_of_the_name_stays(tmp_path: Path) -> None:
    share = install_package(tmp_path, "arm")
    Path(share, "50%25.stl").write_text("")
    finder = PackageFinder({"AMENT_PREFIX_PATH": str(tmp_path)})
    assert finder.resolve_uri("package://arm/50%25.stl", "/") == f"{share}/50%25.stl"
