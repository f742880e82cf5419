import sys

print("loaded")


def talk():
    print("hello")
    sys.stdout.write("written\n")
