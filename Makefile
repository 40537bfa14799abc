# The workflow: make help. Rules and documentation are in Makefile.workflow and docs/workflow.md.
include $(dir $(lastword $(MAKEFILE_LIST)))Makefile.workflow
