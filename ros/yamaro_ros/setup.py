"""Packs yamaro_ros as ROS 2 wants it; colcon runs this."""

from setuptools import setup

NAME = "yamaro_ros"
SHARE = f"share/{NAME}"

setup(
    name=NAME,
    version="1.0.0",
    packages=[NAME],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (SHARE, ["package.xml"]),
        (f"{SHARE}/cmake", ["cmake/yamaro.cmake", "cmake/yamaro_ros-config.cmake"]),
        (f"{SHARE}/launch", ["launch/display.launch.py"]),
        (f"{SHARE}/rviz", ["rviz/display.rviz"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    description="Yamaro in ROS 2: robots in YAML for launch files, CMake and RViz",
    license="GPL-3.0-or-later",
    maintainer="The maintainers of Yamaro",
    maintainer_email="yamaro-maintainers@example.org",
    entry_points={
        "console_scripts": [f"reload = {NAME}.reload:main"],
        "launch.frontend.launch_extension": [f"{NAME} = {NAME}.substitutions"],
    },
)
