pytest_plugins = ["plumbline.pytest_plugin"]
